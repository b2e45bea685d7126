// SPDX-License-Identifier: LGPL-3.0-or-later
// Recorded motions of bodies, with all certificates, and without one of them: what each is worth.
#ifndef CELLWALK_EXPERIMENTS_ABLATION_CERTIFICATES_H
#define CELLWALK_EXPERIMENTS_ABLATION_CERTIFICATES_H

#include <cellwalk/internal/body/certificates.h>

#include <string>
#include <vector>

#include "scenes.h"

namespace cellwalk::ablation {

/// What may prove moves free.
struct Chosen {
  std::string name;  ///< "all", or "no_..."
  bool regions;      ///< whether there are regions free of walls at all
  detail::Body_certificates of_body;
  bool of_edges;
};

/// All certificates, then without one of them, or some; then the same without regions.
std::vector<Chosen> choices();

/// One choice in one scene, by the complete sweep and the rule of traces.
struct Certificate_row {
  std::string scene, chosen;
  bool regions = true;
  Body_counts counts;
  std::uint64_t different = 0;      ///< answers that are not those recorded
  std::vector<double> nanoseconds;  ///< a vertex move, of each round
};

/// All members, for experiments::shared_trials().
template <class Archive, class Value>
void members(Archive& archive,
             Value& row) requires std::same_as<std::remove_const_t<Value>, Certificate_row> {
  archive(row.scene);
  archive(row.chosen);
  archive(row.regions);
  archive(row.counts);
  archive(row.different);
  archive(row.nanoseconds);
}

/// Moves the bodies of a scene by each choice. The first round counts and is judged; the timed ones follow
/// one another choice by choice, so that what disturbs the machine disturbs them alike.
std::vector<Certificate_row> run_certificates(const std::string& name, const real_scenes::Loaded_scene& scene,
                                              int rounds);

}  // namespace cellwalk::ablation

#endif  // CELLWALK_EXPERIMENTS_ABLATION_CERTIFICATES_H
