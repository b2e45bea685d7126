// SPDX-License-Identifier: LGPL-3.0-or-later
// Counts of the parts of a long experiment that are finished, kept in a file: a run that was stopped goes on
// where it was, and gives the same tables.
#ifndef CELLWALK_EXPERIMENTS_COMMON_KEPT_COUNTS_H
#define CELLWALK_EXPERIMENTS_COMMON_KEPT_COUNTS_H

#include <cellwalk/internal/io/durable.h>

#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cellwalk::experiments {

/// One line of JSON for what the counts are of, then one for each part: {"part": NAME, "counts": [...]}. A
/// line is on the device before the next part begins; one that was cut off is made again.
class Kept_counts {
 public:
  /// Keeps nothing.
  Kept_counts() = default;
  /// To be called by all ranks of a run; the first one reads and writes.
  /// \param settings all that the counts depend on, in one line
  /// \param goes_on false: what is in the file is dropped
  /// \throw Error(input) naming the file if its counts are of other settings, or a line is damaged
  Kept_counts(const std::filesystem::path& file, const std::string& settings, bool goes_on);

  /// The counts of a part, which is made if they are not kept. Counts is made of std::uint64_t alone.
  template <class Counts, class Make>
  Counts of(const std::string& part, const Make& make) {
    static_assert(sizeof(Counts) % sizeof(std::uint64_t) == 0);
    using Numbers = std::array<std::uint64_t, sizeof(Counts) / sizeof(std::uint64_t)>;
    if (const auto found = parts_.find(part); found != parts_.end()) {
      Numbers numbers;
      take(part, found->second, numbers.data(), numbers.size());
      return std::bit_cast<Counts>(numbers);
    }
    const Counts counts = make();
    const auto numbers = std::bit_cast<Numbers>(counts);
    keep(part, {numbers.begin(), numbers.end()});
    return counts;
  }

 private:
  void take(const std::string& part, const std::vector<std::uint64_t>& kept, std::uint64_t* numbers,
            std::size_t size) const;
  void keep(const std::string& part, const std::vector<std::uint64_t>& numbers);
  std::uint64_t read(const std::string& text, const std::string& settings);
  [[noreturn]] void refuse(const std::string& why) const;

  std::filesystem::path path_;
  std::map<std::string, std::vector<std::uint64_t>> parts_;
  std::optional<io::Growing_file> file_;  ///< of the first rank
};

}  // namespace cellwalk::experiments

#endif  // CELLWALK_EXPERIMENTS_COMMON_KEPT_COUNTS_H
