// SPDX-License-Identifier: LGPL-3.0-or-later
// Contacts as bytes, see byte_archive.h. Their exact times become the times that are reported.
#ifndef CELLWALK_INTERNAL_SIMULATION_SAVED_CONTACTS_H
#define CELLWALK_INTERNAL_SIMULATION_SAVED_CONTACTS_H

#include <cellwalk/internal/simulation/run_contact.h>

#include <cmath>

namespace cellwalk::detail {

template <class Archive, int D>
void visit_parts(Archive& a, Contact<D>& contact) {
  double time = contact.time;
  a(time, contact.point, contact.normal, contact.kind, contact.corner, contact.facet, contact.cell,
    contact.body, contact.vertex, contact.feature);
  if constexpr (Archive::is_reading) {
    // They are names in tables.
    if (!std::isfinite(time) || contact.kind > Contact_kind::facet || contact.body > Body_feature::face)
      Archive::refuse();
    contact.set_time(Exact_time(time));
  }
}

template <class Archive, int D>
void visit_parts(Archive& a, Run_contact<D>& met) {
  a(met.step, met.particle, met.contact, met.cell, met.body);
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_SIMULATION_SAVED_CONTACTS_H
