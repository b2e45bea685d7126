// SPDX-License-Identifier: LGPL-3.0-or-later
// Fuzz targets: each takes any bytes and may end in two ways, without a word or in an Error that refuses
// them. Everything else is a finding: another exception, a broken promise (demand), what a sanitizer reports,
// much time or memory.
//
// libFuzzer calls one of them in each program of the preset `fuzz` (entry.cpp); test_corpora.cpp calls all of
// them with the files of corpus/, in any build.
#ifndef CELLWALK_TESTS_FUZZ_TARGETS_H
#define CELLWALK_TESTS_FUZZ_TARGETS_H

#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>

namespace cellwalk::fuzz {

// Readers of meshes.
void ovm(std::string_view bytes);
void off(std::string_view bytes);
void obj(std::string_view bytes);
void stl(std::string_view bytes);
void ply(std::string_view bytes);
void poly(std::string_view bytes);
void wkt(std::string_view bytes);
void foam(std::string_view bytes);  ///< the files of an OpenFOAM mesh, parted by lines of %%%%

// What is looked at before a library of others reads a file.
void msh(std::string_view bytes);
void vtk(std::string_view bytes);

// Readers of everything else.
void csv(std::string_view bytes);
void scene(std::string_view bytes);
void record(std::string_view bytes);  ///< of one motion: JSON
void trace(std::string_view bytes);
void motion(std::string_view bytes);
void gzip(std::string_view bytes);

/// Compiled environments: opened, certified, walked and swept.
void compiled(std::string_view bytes);
/// The same with some entries changed: opened, and used without a test before.
void forged(std::string_view bytes);

/// Cells from bytes: built, certified, walked and swept, judged by oracles.
void build(std::string_view bytes);
/// Meshes from bytes whose cells do not conform, judged in rationals.
void nonconforming(std::string_view bytes);
/// Edits from bytes of a small environment, and walks in between.
void edits(std::string_view bytes);
/// Moves of walls from bytes among particles and bodies, judged by oracles.
void moves(std::string_view bytes);

/// Surfaces from bytes: checked for meshing, and their narrowest place found. In builds with `meshing`.
void surface(std::string_view bytes);
/// Surfaces from bytes with defects of all kinds: repaired, meshed and built. In builds with `meshing`.
void repair(std::string_view bytes);

/// A promise that was broken. No Error, so that nobody takes it for a refusal.
struct Finding : std::logic_error {
  using std::logic_error::logic_error;
};

/// \throw Finding unless a promise holds
inline void demand(bool holds, const std::string& promise) {
  if (!holds) throw Finding("finding: " + promise);
}

/// How often something was read and refused, by all inputs together: tests assert that both happened.
struct Outcomes {
  std::size_t read = 0, refused = 0;
};
inline Outcomes outcomes;

/// Runs work that may refuse its input. Returns false if it does.
/// \throw Finding where it refuses by a code that is not allowed, or not in one line of bearable length
template <class Work>
bool reads(const Work& work, std::initializer_list<Error_code> allowed = {Error_code::input}) {
  try {
    work();
    ++outcomes.read;
    return true;
  } catch (const Error& error) {
    const std::string_view message = error.what();
    demand(std::find(allowed.begin(), allowed.end(), error.code()) != allowed.end(),
           "an error has code " + std::to_string(static_cast<int>(error.code())) + ": " + error.what());
    constexpr std::size_t longest = 1000;
    demand(!message.empty() && message.size() <= longest,
           "an error of " + std::to_string(message.size()) + " bytes");
    demand(message.find_first_of("\n\r") == message.npos,
           "an error of several lines: " + std::string(message));
    ++outcomes.refused;
    return false;
  }
}

}  // namespace cellwalk::fuzz

#endif  // CELLWALK_TESTS_FUZZ_TARGETS_H
