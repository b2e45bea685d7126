// SPDX-License-Identifier: LGPL-3.0-or-later
// The state of a simulation as bytes: a world, its walls and the changes to come, which go on from there as
// if they had never stopped. It contains neither the scene nor the environment.
#ifndef CELLWALK_INTERNAL_SIMULATION_SAVED_STATE_H
#define CELLWALK_INTERNAL_SIMULATION_SAVED_STATE_H

#include <cellwalk/internal/kernel/byte_archive.h>
#include <cellwalk/internal/simulation/elastic_foundation.h>
#include <cellwalk/internal/simulation/tissue.h>
#include <cellwalk/internal/simulation/wall_pulsation.h>
#include <cellwalk/internal/simulation/world.h>

namespace cellwalk::detail {

/// Writes where everything is, how it moves, and all counts.
/// \pre no edit of the environment since the world was made but those of its own
/// \throw Error(usage) if there was one
template <int D>
void save(Byte_writer& out, const World<D>& world);
/// The changes that remain.
template <int D>
void save(Byte_writer& out, const Change_schedule<D>& schedule);
template <int D>
void save(Byte_writer& out, const Wall_pulsation<D>& pulsation);
template <int D>
void save(Byte_writer& out, const Elastic_foundation<D>& foundation);
template <int D>
void save(Byte_writer& out, const Tissue<D>& tissue);

/// Saves simulated things, and makes them again from the bytes. The snapshot is that of the environment as it
/// was then, or of a compiled copy; the scene is the same.
/// \throw Error(input) for bytes that are damaged or do not fit these
template <int D>
class State_access {
 public:
  State_access(const Snapshot<D>& snapshot, const Scene<D>& scene) : snapshot_(snapshot), scene_(scene) {}

  World<D> read_world(Byte_reader& in, const Body_options& options) const;
  Change_schedule<D> read_schedule(Byte_reader& in) const;
  Wall_pulsation<D> read_pulsation(Byte_reader& in) const;
  Elastic_foundation<D> read_foundation(Byte_reader& in) const;
  Tissue<D> read_tissue(Byte_reader& in) const;

  static void write(Byte_writer& out, const World<D>& world);

  /// Visits all parts of a state that the scene and the environment do not give.
  /// \throw Error(input) where lengths that were read do not agree
  template <class Archive>
  static void visit(Archive& a, Wall_pulsation<D>& pulsation);
  template <class Archive>
  static void visit(Archive& a, Elastic_foundation<D>& foundation);
  template <class Archive>
  static void visit(Archive& a, Tissue<D>& tissue);
  template <class Archive>
  static void visit(Archive& a, Change_schedule<D>& schedule);
  template <class Archive>
  static void visit(Archive& a, Deformable<D>& body);
  template <class Archive>
  static void visit(Archive& a, Shape_matching<D>& matching);
  template <class Archive>
  static void visit(Archive& a, Rigid_body<D>& body);
  template <class Archive>
  static void visit(Archive& a, Rod<D>& rod);

 private:
  Moving_body<D> read_body(Byte_reader& in, const std::optional<std::size_t>& entry) const;

  const Snapshot<D>& snapshot_;
  const Scene<D>& scene_;
};

extern template class State_access<2>;
extern template class State_access<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_SIMULATION_SAVED_STATE_H
