// SPDX-License-Identifier: GPL-3.0-or-later
// A process that a program is started in. Not by fork(): with threads, a copy of this one could do next to
// nothing before it is replaced.
#ifndef CELLWALK_MESHING_CHILD_PROCESS_H
#define CELLWALK_MESHING_CHILD_PROCESS_H

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "meshing/child/memory_file.h"

namespace cellwalk::detail {

class Process {
 public:
  /// How a process ended: by itself with a code, or by a signal.
  struct End {
    int code = 0, signal = 0;
  };

  /// Starts it in a process group of its own, with standard input `in`, an output at descriptor 3, complaints
  /// at standard error, and signals as they are by default.
  /// \throw Error(other) if the system cannot
  Process(const std::string& program, const std::vector<std::string>& arguments, const Memory_file& in,
          const Memory_file& out, const Memory_file& complaints);
  /// Ends it, and waits until it is no more.
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Waits, as long as no signal comes. Returns nothing while it runs.
  std::optional<End> wait(std::chrono::milliseconds longest);

 private:
  /// The end, if it has come.
  std::optional<End> end(int options);
  void kill() const;

  pid_t id_ = -1;
  int watch_ = -1;  ///< the process as a file, which no other process can become; -1 where there are none
  bool has_ended_ = false;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_CHILD_PROCESS_H
