// SPDX-License-Identifier: LGPL-3.0-or-later
// Rows of the tables that steps of a body return.
#ifndef CELLWALK_PYTHON_BODY_ROWS_H
#define CELLWALK_PYTHON_BODY_ROWS_H

#include <cellwalk/body/body.h>

#include <array>
#include <cstdint>
#include <limits>

#include "motions.h"

namespace cellwalk::python {

/// A row of the table of contacts of a body.
template <int D>
struct Body_contact_row {
  double time;
  std::array<double, D> point, normal;
  std::uint32_t vertex, feature;
  std::int32_t cell;
  std::uint32_t facet, kind, body;
};
// No padding: equal rows are equal bytes.
static_assert(sizeof(Body_contact_row<2>) == 5 * sizeof(double) + 24 &&
              sizeof(Body_contact_row<3>) == 7 * sizeof(double) + 24);
using Body_contact_row_2 = Body_contact_row<2>;
using Body_contact_row_3 = Body_contact_row<3>;

template <int D>
Body_contact_row<D> to_row(const Snapshot<D>& snapshot, const Contact<D>& contact) {
  return {contact.time,
          contact.point,
          contact.normal,
          contact.vertex,
          contact.feature,
          number_of(snapshot, snapshot.cell_of(contact.facet)),
          static_cast<std::uint32_t>(snapshot.facet_of(contact.facet)),
          static_cast<std::uint32_t>(contact.kind),
          static_cast<std::uint32_t>(contact.body)};
}

/// A row of the table of blocked vertices of a body.
template <int D>
struct Rejected_row {
  std::uint64_t edges, swept_edges;
  double time;
  std::array<double, D> point, normal;
  std::uint32_t vertex;
  std::int32_t cell;
  std::uint32_t facet;
  std::uint16_t kind;
  bool stays, is_vertex_blocked;
};
static_assert(sizeof(Rejected_row<2>) == 5 * sizeof(double) + 32 &&
              sizeof(Rejected_row<3>) == 7 * sizeof(double) + 32);
using Blocked_row_2 = Rejected_row<2>;
using Blocked_row_3 = Rejected_row<3>;

template <int D>
Rejected_row<D> to_row(const Snapshot<D>& snapshot, const Rejected_move<D>& move) {
  Rejected_row<D> row{};
  row.edges = move.edges;
  row.swept_edges = move.swept_edges;
  row.vertex = move.vertex;
  row.stays = move.stays();
  row.is_vertex_blocked = move.is_vertex_blocked;
  if (move.contact) {
    row.time = move.contact->time;
    row.point = move.contact->point;
    row.normal = move.contact->normal;
    row.cell = number_of(snapshot, snapshot.cell_of(move.contact->facet));
    row.facet = static_cast<std::uint32_t>(snapshot.facet_of(move.contact->facet));
    row.kind = static_cast<std::uint16_t>(move.contact->kind);
  } else {  // a vertex that moved, with an edge that met something only on the way
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    row.time = none;
    row.point.fill(none);
    row.normal.fill(none);
    row.cell = -1;
  }
  return row;
}

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_BODY_ROWS_H
