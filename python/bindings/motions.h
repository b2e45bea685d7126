// SPDX-License-Identifier: LGPL-3.0-or-later
// The results of a batch of motions: arrays by row, and a table of the contacts.
#ifndef CELLWALK_PYTHON_MOTIONS_H
#define CELLWALK_PYTHON_MOTIONS_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/query/answer.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "arrays.h"
#include "batch.h"
#include "world.h"

namespace cellwalk::python {

/// A row of the table of contacts. Cells are numbered as in the file.
template <int D>
struct Contact_row {
  double time;
  std::array<double, D> point, normal;
  std::uint32_t row;
  std::int32_t cell;
  std::uint16_t facet;
  std::uint8_t kind, body;
};
using Contact_row_2 = Contact_row<2>;
using Contact_row_3 = Contact_row<3>;

/// What Python calls Motions.
struct Motions {
  py::array_t<std::uint8_t> status;
  py::array_t<double> time;
  py::array_t<std::uint32_t> cells;
  py::array contacts;
  py::dict counts;
  std::shared_ptr<const Any_world> world;
  py::array_t<std::uint32_t> handles;  ///< Snapshot's names of the cells
  py::object cell;                     ///< their numbers; made when they are asked for

  std::size_t size() const { return static_cast<std::size_t>(status.size()); }
  const py::object& cell_numbers();
};

/// The number of a cell in the file, or -1 for none.
template <int D>
std::int32_t number_of(const Snapshot<D>& snapshot, Cell cell) {
  return cell == Cell::none ? -1 : static_cast<std::int32_t>(snapshot.index(cell));
}

/// The arrays of a batch while they are filled, which needs no interpreter.
template <int D, class Counts>
class Motion_filler {
 public:
  Motion_filler(const Snapshot<D>& snapshot, Motions& motions, std::size_t rows)
      : snapshot_(snapshot),
        status_(motions.status.mutable_data()),
        time_(motions.time.mutable_data()),
        cells_(motions.cells.mutable_data()),
        handles_(motions.handles.mutable_data()),
        contacts_(chunk_count(rows)),
        counts_(chunk_count(rows)) {}

  Counts& counts(std::size_t chunk) { return counts_[chunk]; }

  void arrive(std::size_t row, Cell cell, std::uint32_t cells) {
    set(row, Motion_status::free, 1, cell, cells);
  }
  /// Outside, invalid or lost.
  void fail(std::size_t row, Motion_status status) {
    set(row, status, std::numeric_limits<double>::quiet_NaN(), Cell::none, 0);
  }
  void meet(std::size_t chunk, std::size_t row, const Wall_contact<D>& contact, Body_feature body,
            std::uint32_t cells) {
    set(row, Motion_status::contact, contact.time, contact.cell, cells);
    contacts_[chunk].push_back({contact.time, contact.point, contact.normal, static_cast<std::uint32_t>(row),
                                number_of(snapshot_, snapshot_.cell_of(contact.facet)),
                                static_cast<std::uint16_t>(snapshot_.facet_of(contact.facet)),
                                static_cast<std::uint8_t>(contact.kind), static_cast<std::uint8_t>(body)});
  }
  void set_answer(std::size_t chunk, std::size_t row, const Answer<D>& answer) {
    if (answer.contact)
      meet(chunk, row, *answer.contact, answer.contact->body, answer.cells);
    else if (answer.status == Motion_status::free)
      arrive(row, answer.cell, answer.cells);
    else
      fail(row, answer.status);
  }

  std::vector<Contact_row<D>> take_contacts() {
    std::vector<Contact_row<D>> all;
    for (const auto& chunk : contacts_) all.insert(all.end(), chunk.begin(), chunk.end());
    return all;
  }
  Counts total() const {
    Counts total;
    for (const Counts& counts : counts_) total += counts;
    return total;
  }

 private:
  void set(std::size_t row, Motion_status status, double time, Cell cell, std::uint32_t cells) {
    status_[row] = static_cast<std::uint8_t>(status);
    time_[row] = time;
    handles_[row] = to_index(cell);
    cells_[row] = cells;
  }

  const Snapshot<D>& snapshot_;
  std::uint8_t* status_;
  double* time_;
  std::uint32_t *cells_, *handles_;
  std::vector<std::vector<Contact_row<D>>> contacts_;  // of each chunk
  std::vector<Counts> counts_;
};

py::dict to_dict(const Walk_counts& counts);
py::dict to_dict(const Edge_counts& counts);

/// Works a batch off: work(filler, chunk, row) answers a row. The interpreter is free meanwhile.
template <class Counts, int D, class Work>
Motions run_batch(const std::shared_ptr<const Any_world>& world, const Snapshot<D>& snapshot,
                  std::size_t rows, int threads, const Work& work) {
  const auto n = static_cast<py::ssize_t>(rows);
  Motions motions{py::array_t<std::uint8_t>(n),
                  py::array_t<double>(n),
                  py::array_t<std::uint32_t>(n),
                  {},
                  {},
                  world,
                  py::array_t<std::uint32_t>(n),
                  py::none()};
  Motion_filler<D, Counts> filler(snapshot, motions, rows);
  {
    const py::gil_scoped_release released;
    for_each_chunk(rows, threads, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
      for (std::size_t row = begin; row < end; ++row) work(filler, chunk, row);
    });
  }
  motions.contacts = to_array(filler.take_contacts());
  motions.counts = to_dict(filler.total());
  return motions;
}

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_MOTIONS_H
