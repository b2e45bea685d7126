// SPDX-License-Identifier: LGPL-3.0-or-later
// The processes that share the work of one run: the ranks that mpirun starts. A program that was started
// otherwise is alone, and neither links nor starts MPI. Theory: docs/scaling.md.
#ifndef CELLWALK_INTERNAL_RANKS_RANKS_H
#define CELLWALK_INTERNAL_RANKS_RANKS_H

#include <cellwalk/kernel/error.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cellwalk {

class Transport;  // src/ranks/transport.h

/// A part of a list: [begin, end).
struct Block {
  std::size_t begin = 0, end = 0;

  std::size_t size() const { return end - begin; }
  bool contains(std::size_t i) const { return i >= begin && i < end; }
};

/// The ranks of a run, seen from one of them. The first writes all output; the others hand it their part.
///
/// An error on a rank is thrown where the first gathers: it is that of the lowest rank, and with blocks in
/// the order of ranks that is the error that a single process would have met first.
class Ranks {
 public:
  /// Alone.
  Ranks();
  /// The ranks that mpirun started, by its environment variables; alone if there are none.
  /// \throw Error(other) if this build lacks MPI, or it cannot be loaded
  static Ranks join();
  Ranks(Ranks&& other) noexcept;
  Ranks& operator=(Ranks&& other) noexcept;
  ~Ranks();

  std::size_t rank() const;
  std::size_t size() const;
  bool is_first() const { return rank() == 0; }
  bool is_alone() const { return size() == 1; }

  /// This rank's block of `count` things: blocks are contiguous, in the order of ranks, and differ in size by
  /// at most one.
  Block block(std::size_t count) const { return block(count, rank()); }
  Block block(std::size_t count, std::size_t of_rank) const {
    return {count * of_rank / size(), count * (of_rank + 1) / size()};
  }

  /// On the first rank: the bytes of every rank, in order. On others, which go on at once unless the first is
  /// several calls behind: nothing.
  /// \throw Error on the first rank: the error with which fail() was called on the lowest of the others
  std::vector<std::string> gather(std::string bytes);
  /// The same, where the first rank uses the bytes of one after the other, its own first.
  void gather(std::string bytes, const std::function<void(std::string)>& use);

  /// The bytes of the first rank, on every rank. All ranks must call it, as often.
  std::string broadcast(std::string bytes);

  /// True if other ranks share the memory of this node.
  bool shares_node() const;
  bool is_first_on_node() const;
  /// The bytes of the first rank of this node, on every one of them.
  std::string broadcast_on_node(std::string bytes);

  /// Ends all ranks, with an exit code, because this one failed. On the first rank and alone: for good,
  /// without a message, which the caller has printed; alone it does nothing. On others: hands the error to
  /// the first, and returns only if that did not need it any more.
  void fail(Error_code code, const std::string& message);

  /// Waits until the first rank has called it too, so that a rank ends only after all is written.
  void leave();

 private:
  explicit Ranks(std::unique_ptr<Transport> transport);

  std::unique_ptr<Transport> transport_;  ///< null: alone
};

/// True if mpirun started this process as one of several, and not the first, by its environment variables.
bool is_later_rank();

/// An optional part of the build: the version of MPI that ranks would use; empty if there is none.
std::string mpi_version();

/// True if a word names the standard input as a file.
bool names_standard_input(std::string_view word);

/// Replaces the standard input of every rank by a copy of the input of the first, which mpirun gives to the
/// first only. Files that are named /dev/stdin can be read by all then.
/// \throw Error(input) if it cannot be read
void share_standard_input(Ranks& ranks);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_RANKS_RANKS_H
