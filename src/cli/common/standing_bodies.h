// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies that stand in an environment while it is changed.
#ifndef CELLWALK_CLI_COMMON_STANDING_BODIES_H
#define CELLWALK_CLI_COMMON_STANDING_BODIES_H

#include <cellwalk/body/body.h>
#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/reshape/move.h>

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace cellwalk::cli {

/// The bodies of some files, registered where these have them.
template <int D>
class Standing_bodies {
 public:
  /// \throw Error naming the file that cannot be read, or whose body does not fit
  Standing_bodies(const std::vector<std::string>& files, const Snapshot<D>& snapshot);

  /// All of them; refers to this object.
  Residents<D> residents();
  bool empty() const { return bodies_.empty(); }
  /// The parts that the readers left out or interpreted, with the file.
  const std::vector<std::string>& notes() const { return notes_; }

  /// Writes where the vertices of all bodies are; nothing if the file is null.
  void write_positions(io::Atomic_file* file) const;
  /// Such as "2 with 20 vertices, 19 edges, 0 faces".
  std::string describe() const;
  nlohmann::ordered_json to_json() const;

 private:
  template <class Size>
  std::size_t sum(const Size& size) const;

  std::vector<Body<D>> bodies_;
  std::vector<std::string> notes_;
};

extern template class Standing_bodies<2>;
extern template class Standing_bodies<3>;

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_COMMON_STANDING_BODIES_H
