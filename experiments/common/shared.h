// SPDX-License-Identifier: LGPL-3.0-or-later
// Trials that the processes of mpirun share (docs/scaling.md). All of them run the same program; each makes
// some of the trials, and gets the results of all. The first writes, and prints; what the others write goes
// into folders of their own that are removed.
#ifndef CELLWALK_EXPERIMENTS_COMMON_SHARED_H
#define CELLWALK_EXPERIMENTS_COMMON_SHARED_H

#include <cellwalk/internal/kernel/byte_archive.h>
#include <cellwalk/internal/ranks/ranks.h>

#include <tbb/parallel_for.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace cellwalk::experiments {

/// The ranks of this program.
Ranks& ranks();

/// Runs run(folder) on every rank, with a folder to write to that exists, and returns its exit code on the
/// first one. A failure is printed once, as "PROGRAM: what", and the exit code is 1.
int run_on_ranks(const std::string& program, const std::filesystem::path& folder,
                 const std::function<int(const std::filesystem::path&)>& run);

/// To be called first of all: later ranks print nothing.
void silence_later_ranks();

/// The bytes of a file.
std::string text_of(const std::filesystem::path& file);

/// Copies files of a folder, whose names begin so, from all ranks to the first.
void gather_files(const std::filesystem::path& folder, const std::string& prefix);

/// Writes results as bytes. What is neither trivially copyable nor made of the types below needs a function
/// members(archive, value), which calls archive(member) for each member.
class Result_writer {
 public:
  template <class T>
  void operator()(const T& value) {
    if constexpr (std::is_trivially_copyable_v<T>)
      bytes_.put_bytes(std::as_bytes(std::span(&value, 1)));
    else
      members(*this, value);
  }
  void operator()(const std::string& value) { bytes_(value); }
  template <class T>
  void operator()(const std::vector<T>& values) {
    bytes_(static_cast<std::uint64_t>(values.size()));
    for (const T& value : values) (*this)(value);
  }
  std::string message() const { return bytes_.message(); }

 private:
  detail::Byte_writer bytes_;
};

/// Reads what a Result_writer wrote.
class Result_reader {
 public:
  explicit Result_reader(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  void operator()(T& value) {
    if constexpr (std::is_trivially_copyable_v<T>)
      std::memcpy(static_cast<void*>(&value), bytes_.take_bytes(sizeof value).data(), sizeof value);
    else
      members(*this, value);
  }
  void operator()(std::string& value) { bytes_(value); }
  template <class T>
  void operator()(std::vector<T>& values) {
    values.resize(bytes_.next<std::uint64_t>());
    for (T& value : values) (*this)(value);
  }

 private:
  detail::Byte_reader bytes_;
};

enum class Trials {
  on_threads,  ///< several at a time
  in_order,    ///< one after the other on each rank
  timed        ///< all on the first rank, in order, so that others do not disturb it
};

/// True for a rank that has nothing to do where times are taken: it may leave.
inline bool is_idle(bool is_timed) { return is_timed && !ranks().is_first(); }

/// The results of trials 0 to count - 1, on every rank. Rank r of n makes trials r, r + n, and so on.
/// \pre if they are timed, this is the first rank
template <class Trial>
auto shared_trials(std::size_t count, const Trial& trial, Trials how = Trials::on_threads) {
  using Result = std::decay_t<decltype(trial(std::size_t{0}))>;
  const bool is_alone = how == Trials::timed || ranks().is_alone();
  const std::size_t first = is_alone ? 0 : ranks().rank(), step = is_alone ? 1 : ranks().size();
  const std::size_t own = first < count ? (count - first + step - 1) / step : 0;
  std::vector<Result> results(count);
  const auto make = [&](std::size_t i) { results[first + i * step] = trial(first + i * step); };
  if (how == Trials::on_threads)
    tbb::parallel_for(std::size_t{0}, own, make);
  else
    for (std::size_t i = 0; i < own; ++i) make(i);
  if (is_alone) return results;
  Result_writer of_rank;
  for (std::size_t i = first; i < count; i += step) of_rank(results[i]);
  std::size_t from = 0;
  ranks().gather(of_rank.message(), [&](const std::string& bytes) {
    Result_reader reader(bytes);
    for (std::size_t i = from; i < count; i += step) reader(results[i]);
    ++from;
  });
  Result_writer all;
  if (ranks().is_first()) all(results);
  const std::string shared = ranks().broadcast(all.message());
  Result_reader reader(shared);
  reader(results);
  return results;
}

}  // namespace cellwalk::experiments

#endif  // CELLWALK_EXPERIMENTS_COMMON_SHARED_H
