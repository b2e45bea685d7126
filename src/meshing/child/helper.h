// SPDX-License-Identifier: GPL-3.0-or-later
// The ends of a helper program that all have in common.
#ifndef CELLWALK_MESHING_CHILD_HELPER_H
#define CELLWALK_MESHING_CHILD_HELPER_H

#include <cellwalk/internal/kernel/byte_archive.h>

#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <span>
#include <string_view>
#include <vector>

#include "meshing/child/protocol.h"

namespace cellwalk::detail {

/// Ends at once: nothing is cleaned up that could fail after a mesher did.
[[noreturn]] inline void end_helper(int code) { _exit(code); }

/// Standard input to its end.
inline std::vector<std::byte> read_input() {
  std::vector<std::byte> bytes;
  std::array<std::byte, 65536> part;
  for (;;) {
    const ssize_t got = ::read(STDIN_FILENO, part.data(), part.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) end_helper(cut_short);
    if (got == 0) return bytes;
    bytes.insert(bytes.end(), part.begin(), part.begin() + got);
  }
}

/// Begins a helper: it dies with its parent, leaves no file behind, and reads its input.
/// \return its options
inline std::span<char* const> begin_helper(int argc, char** argv, Mesher_input& input) {
  constexpr int version = 1, parent = 2, options = 3;  // places of the arguments
  if (argc < options || std::string_view(argv[version]) != CELLWALK_VERSION) end_helper(other_version);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != std::atoi(argv[parent])) end_helper(cut_short);  // it was dead before
  // No core, nor one for a program that collects them, and no file at all: Mesh_3 would leave its dumps where
  // the user works.
  prctl(PR_SET_DUMPABLE, 0);
  const rlimit no_core{0, 0}, no_more_files{output_descriptor + 1, output_descriptor + 1};
  setrlimit(RLIMIT_CORE, &no_core);
  setrlimit(RLIMIT_NOFILE, &no_more_files);
  try {
    const std::vector<std::byte> bytes = read_input();
    Byte_reader reader(bytes);
    reader(input);
    reader.expect_end();
  } catch (const Error&) {
    end_helper(cut_short);
  } catch (const std::bad_alloc&) {
    end_helper(out_of_memory);
  }
  return {argv + options, static_cast<std::size_t>(argc - options)};
}

/// Writes the output, and ends.
[[noreturn]] inline void end_with(const Mesher_output& output) {
  Byte_writer writer;
  writer(output);
  for (std::span<const std::byte> rest(writer.bytes()); !rest.empty();) {
    const ssize_t written = ::write(output_descriptor, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) end_helper(cut_short);
    rest = rest.subspan(static_cast<std::size_t>(written));
  }
  end_helper(0);
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_CHILD_HELPER_H
