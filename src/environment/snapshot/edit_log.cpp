// SPDX-License-Identifier: LGPL-3.0-or-later
// The entries of edits by epoch, renamed at compaction and forgotten when there are too many.
#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/environment/edit_log.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace cellwalk::detail {
namespace {

constexpr std::size_t most_entries = std::size_t{1} << 20;

constexpr std::uint32_t no_name = to_index(Cell::none);

/// Forgets half of the entries if there are too many; then `lost_at` is the epoch of the last of these.
template <class Entry>
void add(std::vector<Entry>& entries, const Entry& entry, std::uint64_t& lost_at) {
  if (entries.size() == most_entries) {
    const auto end = entries.begin() + most_entries / 2;
    lost_at = std::max(lost_at, std::prev(end)->epoch);
    entries.erase(entries.begin(), end);
  }
  entries.push_back(entry);
}

/// The entries after an epoch, in their order.
template <class Entry>
std::span<const Entry> entries_since(const std::vector<Entry>& entries, std::uint64_t epoch) {
  auto first = entries.end();
  while (first != entries.begin() && std::prev(first)->epoch > epoch) --first;
  return {first, entries.end()};
}

template <class Entry, class Name>
void rename(std::vector<Entry>& entries, const std::vector<Name>& by_old_name) {
  for (Entry& entry : entries)
    entry.name = entry.name < by_old_name.size() ? to_index(by_old_name[entry.name]) : no_name;
  std::erase_if(entries, [](const Entry& entry) { return entry.name == no_name; });
}

template <class Name>
Name renamed_by(const std::vector<Name>& names, Name old) {
  return to_index(old) < names.size() ? names[to_index(old)] : Name::none;
}

[[noreturn]] void refuse_forgotten() {
  throw Error(Error_code::usage,
              "the environment was edited too often since this was registered, so that it is not known any "
              "more on which sides of walls it was: make it anew");
}

}  // namespace

bool Edits_since::is_new(Cell cell) const {
  const auto found =
      std::lower_bound(new_cells_.begin(), new_cells_.end(), std::pair(to_index(cell), std::uint64_t{0}));
  return found != new_cells_.end() && found->first == to_index(cell);
}

bool Edits_since::is_turned(Half_facet facet) const {
  return std::binary_search(turned_.begin(), turned_.end(), to_index(facet));
}

Cell Edits_since::renamed(Cell cell) const {
  if (are_lost_) refuse_forgotten();
  return renaming_ ? renamed_by(renaming_->cells, cell) : cell;
}

Half_facet Edits_since::renamed(Half_facet facet) const {
  if (are_lost_) refuse_forgotten();
  return renaming_ ? renamed_by(renaming_->half_facets, facet) : facet;
}

template <int D>
bool was_passable(const Snapshot<D>& snapshot, const Edits_since& edits, Half_facet facet) {
  const auto is_new = [&](Half_facet side) { return edits.is_new(snapshot.cell_of(side)); };
  const bool is_passable = !snapshot.is_impassable(facet);
  if (!is_new(facet)) return is_passable != edits.is_turned(facet);
  const Half_facet other = snapshot.opposite(facet);
  return other == Half_facet::none || is_new(other) ? is_passable : is_passable != edits.is_turned(other);
}

template bool was_passable(const Snapshot<2>&, const Edits_since&, Half_facet);
template bool was_passable(const Snapshot<3>&, const Edits_since&, Half_facet);

void Edits_since::add_parts(std::uint32_t cell, std::uint64_t epoch, std::vector<Cell>& parts) const {
  auto part = std::lower_bound(parts_.begin(), parts_.end(), Part{cell, epoch + 1, 0});
  const auto renewed = std::lower_bound(new_cells_.begin(), new_cells_.end(), std::pair(cell, epoch + 1));
  const bool is_split = part != parts_.end() && part->of == cell;
  if (renewed != new_cells_.end() && renewed->first == cell && !(is_split && part->epoch < renewed->second))
    return;  // another cell got its name
  if (!is_split) {
    parts.push_back(Cell{cell});
    return;
  }
  for (const std::uint64_t edit = part->epoch;
       part != parts_.end() && part->of == cell && part->epoch == edit; ++part)
    add_parts(part->name, edit, parts);
}

std::vector<Cell> Edits_since::parts_of(Cell cell) const {
  std::vector<Cell> parts;
  add_parts(to_index(cell), 0, parts);
  return parts;
}

void Edit_log::reserve_turned(std::size_t sides) {
  const std::size_t size = turned_.size() + sides;
  if (turned_.capacity() < size) turned_.reserve(std::max(size, 2 * turned_.capacity()));
}

void Edit_log::note_turned(std::uint64_t epoch, Half_facet one, Half_facet other) {
  for (const Half_facet f : {one, other})
    if (f != Half_facet::none) add(turned_, {epoch, to_index(f)}, lost_at_);
}

void Edit_log::note_new(std::uint64_t epoch, std::span<const Cell> cells, Cell of) {
  for (const Cell cell : cells) add(new_cells_, {epoch, to_index(cell), to_index(of)}, lost_at_);
}

void Edit_log::note_renamed(std::uint64_t epoch, Renaming names) {
  rename(new_cells_, names.cells);
  for (New_cell& cell : new_cells_) cell.of = no_name;
  rename(turned_, names.half_facets);
  if (renaming_) lost_at_ = std::max(lost_at_, renamed_at_);
  renamed_at_ = epoch;
  renaming_ = std::make_shared<const Renaming>(std::move(names));
}

Edits_since Edit_log::since(std::uint64_t epoch) const {
  Edits_since result;
  for (const New_cell& cell : entries_since(new_cells_, epoch)) {
    result.new_cells_.emplace_back(cell.name, cell.epoch);
    if (cell.of != no_name) result.parts_.push_back({cell.of, cell.epoch, cell.name});
  }
  std::ranges::sort(result.new_cells_);
  std::ranges::sort(result.parts_);
  std::vector<std::uint32_t> turned;
  for (const Turned& facet : entries_since(turned_, epoch)) turned.push_back(facet.name);
  std::ranges::sort(turned);
  for (const std::uint32_t name : turned)  // a facet that was turned twice is as it was
    if (!result.turned_.empty() && result.turned_.back() == name)
      result.turned_.pop_back();
    else
      result.turned_.push_back(name);
  if (epoch < renamed_at_) result.renaming_ = renaming_;
  result.are_lost_ = epoch < lost_at_;
  return result;
}

}  // namespace cellwalk::detail
