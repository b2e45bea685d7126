// SPDX-License-Identifier: LGPL-3.0-or-later
#include "common/kept_counts.h"

#include <cellwalk/kernel/error.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string_view>

#include "common/shared.h"

namespace cellwalk::experiments {

Kept_counts::Kept_counts(const std::filesystem::path& file, const std::string& settings, bool goes_on)
    : path_(file) {
  const std::string text = ranks().broadcast(goes_on && ranks().is_first() ? text_of(file) : std::string());
  const std::uint64_t length = read(text, settings);
  if (!ranks().is_first()) return;
  file_.emplace(path_, length);
  if (length > 0) return;
  file_->write(settings + "\n");
  file_->sync();
  io::sync(path_.parent_path().empty() ? "." : path_.parent_path());
}

/// Reads the lines that are whole; returns their length.
std::uint64_t Kept_counts::read(const std::string& text, const std::string& settings) {
  std::uint64_t begin = 0;
  for (std::size_t line = 1;; ++line) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) return begin;
    const std::string_view words(text.data() + begin, end - begin);
    begin = end + 1;
    if (line == 1) {
      if (words != settings)
        refuse(
            fmt::format("has counts of other settings: {}; these are {}; remove it, or name another folder",
                        words, settings));
      continue;
    }
    const auto part = nlohmann::json::parse(words, nullptr, false);
    try {
      parts_[part.at("part").get<std::string>()] = part.at("counts").get<std::vector<std::uint64_t>>();
    } catch (const nlohmann::json::exception&) {
      refuse(fmt::format("line {} is damaged; remove the file to begin anew", line));
    }
  }
}

void Kept_counts::take(const std::string& part, const std::vector<std::uint64_t>& kept,
                       std::uint64_t* numbers, std::size_t size) const {
  if (kept.size() != size) refuse(fmt::format("part '{}' has {} counts, not {}", part, kept.size(), size));
  std::copy(kept.begin(), kept.end(), numbers);
}

void Kept_counts::keep(const std::string& part, const std::vector<std::uint64_t>& numbers) {
  parts_[part] = numbers;
  if (!file_) return;
  const nlohmann::ordered_json line{{"part", part}, {"counts", numbers}};
  file_->write(line.dump() + "\n");
  file_->sync();
}

void Kept_counts::refuse(const std::string& why) const {
  throw Error(Error_code::input, fmt::format("{}: {}", path_.string(), why));
}

}  // namespace cellwalk::experiments
