// SPDX-License-Identifier: GPL-3.0-or-later
// The search for a helper, its limits of time, and its complaints as errors.
#include "run_helper.h"

#include <cellwalk/internal/kernel/beside_program.h>
#include <cellwalk/internal/kernel/byte_archive.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <string_view>

#include "meshing/child/memory_file.h"
#include "meshing/child/process.h"

namespace cellwalk::detail {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// The longest time between two tests whether to go on.
constexpr std::chrono::milliseconds longest_silence{100};
/// Bytes of a complaint that are read, and those that are shown.
constexpr std::size_t longest_complaint = 4096, longest_shown = 160;

[[noreturn]] void fail(const Helper& helper, const std::string& what) {
  throw Error(Error_code::not_certified, fmt::format("{} {}", helper.mesher, what));
}

[[noreturn]] void give_up(const Helper& helper, const std::string& what) {
  throw Used_up(Error_code::not_certified, fmt::format("{} {}", helper.mesher, what));
}

[[noreturn]] void refuse_missing(const Helper& helper) {
  throw Error(Error_code::usage,
              fmt::format("this build has no {}: the program {} is not there; build it ({}), or name its "
                          "folder in CELLWALK_LIBEXEC",
                          helper.mesher, helper.program,
                          helper.program == tetgen_helper.program
                              ? "with libtet1.5-dev; or mesh with Mesh_3, which approximates the surface"
                              : "by -DCELLWALK_WITH_MESHING=ON"));
}

/// The first line of the complaint of a helper, with the text that an assertion prints first, in brackets; or
/// nothing.
std::string complaint(const Memory_file& messages) {
  const std::vector<std::byte> bytes = messages.read(longest_complaint);
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  text = text.substr(0, text.find_first_of(std::string_view("\r\n\0", 3)));
  if (const auto assertion = text.find("Assertion `"); assertion != text.npos) text.remove_prefix(assertion);
  std::string line(text.substr(0, longest_shown));
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
  while (!line.empty() && (line.back() == '.' || line.back() == ' ')) line.pop_back();
  if (text.size() > longest_shown) line += "...";
  return line.empty() ? "" : fmt::format(": {}", line);
}

/// The meaning of the numbers that TetGen throws (terminatetetgen in tetgen.h).
const char* meaning(int code) {
  switch (code) {
    case 2:
      return "failed inside";
    case 3:
      return "found that the surfaces intersect";
    case 4:
      return "found two features too close for its tolerance";
    case 5:
      return "found two facets too close to each other";
    case 10:
      return "found its input malformed";
    default:
      return "could not keep the boundary";
  }
}

/// \throw Error(not_certified) for every end but success
void expect_success(const Helper& helper, const Process::End& end, const Memory_file& messages) {
  if (end.signal != 0) {
    const char* name = sigabbrev_np(end.signal);
    fail(helper, fmt::format("crashed (signal {}, SIG{}{})", end.signal, name != nullptr ? name : "?",
                             complaint(messages)));
  }
  if (end.code == 0) return;
  if (end.code == other_version)
    throw Error(Error_code::usage,
                fmt::format("{} is of another version of Cellwalk than {}: name the folder "
                            "of this one's in CELLWALK_LIBEXEC",
                            helper.program, CELLWALK_VERSION));
  if (end.code == out_of_memory) give_up(helper, "ran out of memory; give a smaller surface or larger cells");
  if (end.code == mesher_failed) fail(helper, fmt::format("failed{}", complaint(messages)));
  constexpr int largest_code = 10;  // that TetGen throws
  if (end.code > mesher_failed && end.code <= mesher_failed + largest_code)
    fail(helper,
         fmt::format("{} (its code {})", meaning(end.code - mesher_failed), end.code - mesher_failed));
  fail(helper, fmt::format("crashed (exit code {}{})", end.code, complaint(messages)));
}

/// Waits for the end.
Process::End end_of(Process& process, const Helper& helper, const Mesher_limits& limits,
                    Clock::time_point start) {
  for (;;) {
    const std::chrono::duration<double> left(limits.seconds -
                                             std::chrono::duration<double>(Clock::now() - start).count());
    if (left.count() <= 0)
      give_up(helper, fmt::format("did not end within {:g} s, the limit of time", limits.seconds));
    // Not longer than until the limit, and a millisecond more, since a part of one would be none.
    const auto longest = std::min<std::chrono::duration<double>>(left, longest_silence);
    const auto end = process.wait(std::chrono::duration_cast<std::chrono::milliseconds>(longest) +
                                  std::chrono::milliseconds(1));
    if (limits.on_wait) limits.on_wait();
    if (end) return *end;
  }
}

}  // namespace

fs::path find_helper(const Helper& helper) {
  const auto runs = [](const fs::path& file) { return ::access(file.c_str(), X_OK) == 0; };
  if (const char* chosen = secure_getenv("CELLWALK_LIBEXEC"))
    if (const fs::path file = fs::path(chosen) / helper.program; runs(file)) return file;
  const fs::path below = fs::path(CELLWALK_INSTALL_LIBEXECDIR) / "cellwalk" / helper.program;
  for (const fs::path& file : beside_program(below))
    if (runs(file)) return file;
  for (const fs::path& file : beside_libraries(below))
    if (runs(file)) return file;
  const fs::path installed = fs::path(CELLWALK_INSTALL_PREFIX) / below;
  return runs(installed) ? installed : fs::path();
}

Mesher_output run_helper(const Helper& helper, const std::vector<std::string>& options,
                         const Mesher_input& input, const Mesher_limits& limits, Clock::time_point start) {
  if (!(limits.seconds > 0))
    throw Error(Error_code::usage,
                fmt::format("{}: the limit of time must be greater than 0", helper.mesher));
  const fs::path program = find_helper(helper);
  if (program.empty()) refuse_missing(helper);
  Memory_file in, out, messages;
  {
    Byte_writer writer;
    writer(input);
    in.write(writer.bytes());
    in.rewind();
  }
  std::vector<std::string> arguments{CELLWALK_VERSION, std::to_string(::getpid())};
  arguments.insert(arguments.end(), options.begin(), options.end());
  Process process(program.string(), arguments, in, out, messages);
  expect_success(helper, end_of(process, helper, limits, start), messages);
  const std::vector<std::byte> bytes = out.read();
  try {
    Mesher_output output;
    Byte_reader reader(bytes);
    reader(output);
    reader.expect_end();
    return output;
  } catch (const Error&) {
    fail(helper, fmt::format("wrote half a result ({} bytes)", bytes.size()));
  }
}

}  // namespace cellwalk::detail
