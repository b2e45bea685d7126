// SPDX-License-Identifier: LGPL-3.0-or-later
// Puts obstacles and membranes where a test wants them, in the text of a generated environment.
#ifndef CELLWALK_TESTS_CLI_OVM_TEXT_H
#define CELLWALK_TESTS_CLI_OVM_TEXT_H

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace cellwalk::test {

class Ovm_text {
 public:
  /// \pre the environment has no solid cells
  explicit Ovm_text(const std::string& text) {
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines_.push_back(line);
    in_space_ = lines_.at(line_of("MProp int \"dimension\"") + 1) == "3";
    solid_.resize(std::stoul(lines_.at(line_of(in_space_ ? "Polyhedra" : "Faces") + 1)));
  }

  Ovm_text& set_solid(std::size_t cell) {
    for (const std::size_t facet : facets(cell)) set_wall(facet);
    solid_.at(cell) = true;
    return *this;
  }

  /// A membrane: all facets that two cells share.
  Ovm_text& separate(std::size_t cell, std::size_t other) {
    const auto others = facets(other);
    for (const std::size_t facet : facets(cell))
      if (std::find(others.begin(), others.end(), facet) != others.end()) set_wall(facet);
    return *this;
  }

  std::string text() const {
    std::string text;
    for (const std::string& line : lines_) {
      text += line;
      text += '\n';
    }
    text += in_space_ ? "CProp bool \"solid\"\n" : "FProp bool \"solid\"\n";
    for (const bool solid : solid_) text += solid ? "1\n" : "0\n";
    return text;
  }

 private:
  std::size_t line_of(const std::string& heading) const {
    const auto found = std::find(lines_.begin(), lines_.end(), heading);
    if (found == lines_.end()) throw std::runtime_error("no line " + heading);
    return static_cast<std::size_t>(found - lines_.begin());
  }

  std::vector<std::size_t> facets(std::size_t cell) const {
    std::istringstream halves(lines_.at(line_of(in_space_ ? "Polyhedra" : "Faces") + 2 + cell));
    std::size_t count = 0, half = 0;
    halves >> count;
    std::vector<std::size_t> facets;
    while (halves >> half) facets.push_back(half / 2);
    if (facets.size() != count) throw std::runtime_error("not a cell");
    return facets;
  }

  void set_wall(std::size_t facet) {
    const std::size_t walls = line_of(in_space_ ? "FProp bool \"impassable\"" : "EProp bool \"impassable\"");
    lines_.at(walls + 1 + facet).assign(1, '1');
  }

  std::vector<std::string> lines_;
  std::vector<bool> solid_;
  bool in_space_ = false;
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_CLI_OVM_TEXT_H
