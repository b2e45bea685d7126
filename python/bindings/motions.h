// SPDX-License-Identifier: LGPL-3.0-or-later
// The results of a batch of motions: arrays by row, and a table of the contacts.
#ifndef CELLWALK_PYTHON_MOTIONS_H
#define CELLWALK_PYTHON_MOTIONS_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/query/query.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
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
  std::uint32_t facet;
  std::uint16_t kind, body;
};
// No padding: equal rows are equal bytes.
static_assert(sizeof(Contact_row<2>) == 5 * sizeof(double) + 16 &&
              sizeof(Contact_row<3>) == 7 * sizeof(double) + 16);
using Contact_row_2 = Contact_row<2>;
using Contact_row_3 = Contact_row<3>;

/// The class Motions of Python. A small move takes a few nanoseconds, and memory that is written for the
/// first time costs as much: arrays that can be made when they are requested are not written before.
struct Motions {
  py::array_t<std::uint8_t> status;
  py::array_t<std::uint32_t> cells;
  py::array contacts;
  py::dict counts;
  std::shared_ptr<const Any_world> world;
  /// Row and time of each contact; `contacts` belongs to the caller.
  std::vector<std::pair<std::size_t, double>> stops;
  py::array_t<std::uint32_t> handles;  ///< Snapshot's names of the cells; none where no motion was made
  /// Row and distance of each start that is closer to a wall than its radius.
  std::vector<std::pair<std::size_t, double>> close = {};
  py::object cell = py::none(), time = py::none(), distance = py::none();  ///< made when they are requested

  std::size_t size() const { return static_cast<std::size_t>(status.size()); }
  const py::object& cell_numbers();
  const py::object& times();
  const py::object& distances();
};

/// True if all coordinates are finite, without a branch: x - x is 0 or not a number.
template <std::size_t D>
bool is_usable(const std::array<double, D>& x) {
  double sum = 0;
  for (const double coordinate : x) sum += coordinate - coordinate;
  return sum == 0;
}

/// The number of a cell in the file, or -1 for none.
template <int D>
std::int32_t number_of(const Snapshot<D>& snapshot, Cell cell) {
  return cell == Cell::none ? -1 : static_cast<std::int32_t>(snapshot.index(cell));
}

/// Where the rows of a batch are written; needs no interpreter. To be copied into loops, so that the compiler
/// can see that nothing else changes it.
template <int D>
struct Motion_rows {
  Motion_status* status;  // not bytes, which the compiler takes to change anything else when they are written
  std::uint32_t *cells, *handles;

  void arrive(std::size_t row, Cell cell, std::uint32_t visited) const {
    set(row, Motion_status::free, cell, visited);
  }
  void meet(std::size_t row, const Contact<D>& contact, std::uint32_t visited) const {
    set(row, Motion_status::contact, contact.cell, visited);
  }
  /// Outside, invalid, lost or close.
  void fail(std::size_t row, Motion_status why) const { set(row, why, Cell::none, 0); }

 private:
  void set(std::size_t row, Motion_status what, Cell cell, std::uint32_t visited) const {
    status[row] = what;
    handles[row] = to_index(cell);
    cells[row] = visited;
  }
};

/// The contacts and counts that a chunk of a batch adds.
template <int D, class Counts>
struct Chunk {
  std::vector<Contact_row<D>> contacts;
  std::vector<std::pair<std::size_t, double>> close;
  Counts counts;

  void add(const Snapshot<D>& snapshot, std::size_t row, const Contact<D>& contact) {
    contacts.push_back({contact.time, contact.point, contact.normal, static_cast<std::uint32_t>(row),
                        number_of(snapshot, snapshot.cell_of(contact.facet)),
                        static_cast<std::uint32_t>(snapshot.facet_of(contact.facet)),
                        static_cast<std::uint16_t>(contact.kind), static_cast<std::uint16_t>(contact.body)});
  }
};

/// The counts of a set by the names that reports give them, without those of its inner sets.
template <Count_set Set>
py::dict to_dict(const Set& counts) {
  py::dict result;
  for (const auto& [name, count] : named_counts(counts)) result[py::str(name)] = count;
  return result;
}
py::dict to_dict(const Walk_counts& counts);
py::dict to_dict(const Edge_counts& counts);

/// Works a batch off: begin(reading) returns work(rows, chunk, first row, row after the last), which answers
/// a chunk. The interpreter is free meanwhile.
/// \param owner the lock of the particles of the batch, or null
template <class Counts, int D, class Begin>
Motions run_batch(const std::shared_ptr<const Any_world>& world, std::mutex* owner, std::size_t rows,
                  int threads, const Begin& begin) {
  const auto n = static_cast<py::ssize_t>(rows);
  Motions motions{py::array_t<std::uint8_t>(n), py::array_t<std::uint32_t>(n), {}, {}, world, {},
                  py::array_t<std::uint32_t>(n)};
  const Motion_rows<D> out{reinterpret_cast<Motion_status*>(motions.status.mutable_data()),
                           motions.cells.mutable_data(), motions.handles.mutable_data()};
  std::vector<Contact_row<D>> contacts;
  Counts counts;
  const auto run = [&](const typename World<D>::Reading& reading) {
    const auto work = begin(reading);
    std::vector<Chunk<D, Counts>> chunks(chunk_count(rows));
    for_each_chunk(rows, threads, [&](std::size_t chunk, std::size_t first, std::size_t last) {
      work(out, chunks[chunk], first, last);
    });
    for (const Chunk<D, Counts>& chunk : chunks) {
      contacts.insert(contacts.end(), chunk.contacts.begin(), chunk.contacts.end());
      motions.close.insert(motions.close.end(), chunk.close.begin(), chunk.close.end());
      counts += chunk.counts;
    }
    for (const Contact_row<D>& contact : contacts) motions.stops.emplace_back(contact.row, contact.time);
  };
  const auto& of_world = std::get<World<D>>(*world);
  owner ? run(typename World<D>::Reading(of_world, *owner)) : run(typename World<D>::Reading(of_world));
  motions.contacts = to_array(std::move(contacts));
  motions.counts = to_dict(counts);
  return motions;
}

/// A batch of questions: answer_row(snapshot, locator, row, counts) answers one.
template <int D, class Answer_row>
Motions run_questions(const std::shared_ptr<const Any_world>& world, std::size_t rows, int threads,
                      const Answer_row& answer_row) {
  return run_batch<Edge_counts, D>(
      world, nullptr, rows, threads, [&](const typename World<D>::Reading& reading) {
        return
            [&answer_row, &snapshot = reading.snapshot(), &locator = reading.locator()](
                const Motion_rows<D>& out, Chunk<D, Edge_counts>& chunk, std::size_t begin, std::size_t end) {
              for (std::size_t row = begin; row < end; ++row) {
                const Answer<D> answer = answer_row(snapshot, locator, row, chunk.counts);
                if (answer.status == Motion_status::close) {
                  out.fail(row, answer.status);
                  chunk.close.emplace_back(row, answer.contact->distance);
                  Contact<D> nearest = *answer.contact;
                  nearest.time = std::numeric_limits<double>::quiet_NaN();
                  chunk.add(snapshot, row, nearest);
                } else if (answer.contact) {
                  out.meet(row, *answer.contact, answer.cells);
                  chunk.add(snapshot, row, *answer.contact);
                } else if (answer.status == Motion_status::free) {
                  out.arrive(row, answer.cell, answer.cells);
                } else {
                  out.fail(row, answer.status);
                }
              }
            };
      });
}

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_MOTIONS_H
