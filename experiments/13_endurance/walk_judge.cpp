// SPDX-License-Identifier: LGPL-3.0-or-later
#include "walk_judge.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace cellwalk::endurance {
namespace {

/// Sign of numerator - t * denominator.
/// \pre 0 <= t <= 1
int side_of_time(double t, const Time& time) {
  int exponent = 0;
  const auto digits = static_cast<Whole>(std::ldexp(std::frexp(t, &exponent), 53));
  const int shift = 53 - exponent;  // t = digits / 2^shift
  if (digits == 0 || time.numerator == 0) return (time.numerator > 0) - (digits > 0);
  const Wide right = Wide(digits) * time.denominator;  // below 2^116
  const int bits = 64 - std::countl_zero(static_cast<std::uint64_t>(time.numerator));
  if (bits + shift > 126) return 1;
  const Wide left = Wide(time.numerator) << shift;
  return (left > right) - (left < right);
}

}  // namespace

bool is_rounded(double t, const Time& time) {
  if (!(t >= 0 && t <= 1)) return false;
  return side_of_time(t, time) >= 0 && (t == 1 || side_of_time(std::nextafter(t, 2.0), time) < 0);
}

template <int D>
Walk_judge<D>::Walk_judge(const Lattice<D>& lattice, int bits)
    : lattice_(lattice), bits_(bits), seen_(lattice.cell_count(), 0) {}

template <int D>
bool Walk_judge<D>::may_end_in(std::uint32_t cell) const {
  return std::find(cells_.begin(), cells_.end(), cell) != cells_.end();
}

template <int D>
void Walk_judge<D>::begin(const Site<D>& a, const Site<D>& b) {
  const auto& families = lattice_.families();
  for (std::size_t j = 0; j < families.size(); ++j) {
    Crossing& c = crossings_[j];
    c.value = families[j](a);
    c.way = families[j](b) - c.value;
    c.plane = static_cast<std::int16_t>(c.value >> bits_);
    c.speed = std::abs(c.way);
  }
}

/// All cells linked with those of cells_ at the present point, on whose planes these families are.
template <int D>
void Walk_judge<D>::link(unsigned on) {
  ++links_;
  linked_.clear();
  for (const std::uint32_t c : cells_) {
    linked_.push_back(c);
    seen_[c] = links_;
  }
  for (std::size_t at = 0; at < linked_.size(); ++at) {
    const Side* sides = lattice_.sides(linked_[at]);
    for (std::size_t i = 0; i < lattice_.sides_of_cell(); ++i) {
      const std::uint32_t beyond = sides[i].beyond;
      if (beyond == no_cell || !is_at(sides[i], on) || seen_[beyond] == links_) continue;
      seen_[beyond] = links_;
      linked_.push_back(beyond);
    }
  }
}

/// Leaves in linked_ the cells that hold a further piece of the motion; false if there is none.
template <int D>
bool Walk_judge<D>::enter(unsigned on) {
  std::size_t left = 0;
  for (const std::uint32_t c : linked_) {
    const auto& floors = lattice_.floors(c);
    bool holds = true;
    for (unsigned rest = on; rest && holds; rest &= rest - 1) {
      const auto j = static_cast<std::size_t>(std::countr_zero(rest));
      const Crossing& f = crossings_[j];
      if (f.way > 0) holds = floors[j] == f.plane;
      if (f.way < 0) holds = floors[j] == f.plane - 1;
    }
    if (holds) linked_[left++] = c;
  }
  linked_.resize(left);
  return left > 0;
}

/// True if not all cells that hold the motion are linked all along it.
/// \param within the families on whose planes it runs
template <int D>
bool Walk_judge<D>::is_divided(unsigned within) {
  const std::vector<std::uint32_t> all = cells_;
  cells_.resize(1);
  link(within);
  cells_ = all;
  return std::any_of(all.begin(), all.end(), [this](std::uint32_t c) { return seen_[c] != links_; });
}

template <int D>
const Walk_truth& Walk_judge<D>::follow(std::uint32_t cell, const Site<D>& a, const Site<D>& b) {
  begin(a, b);
  truth_ = {};
  cells_.assign(1, cell);
  const std::size_t count = lattice_.families().size();
  const Whole unit = Whole{1} << bits_;
  unsigned on = 0, within = 0;  // families on a plane here; all the way
  for (std::size_t j = 0; j < count; ++j) {
    const Crossing& f = crossings_[j];
    if ((f.value & (unit - 1)) != 0) continue;
    on |= 1u << j;
    if (f.way == 0) within |= 1u << j;
  }
  truth_.degenerate = within != 0;
  const auto pass = [&](const Time& time) {
    truth_.degenerate |= lattice_.dimension(on) < D - 1;
    link(on);
    if (enter(on)) {
      cells_.swap(linked_);
      if (within != 0 && is_divided(within)) truth_.has_choice = true;
      return true;
    }
    truth_.end = time;
    truth_.dimension = lattice_.dimension(on);
    at_end_ = on;
    return false;
  };
  if (a != b && !pass({0, 1})) return truth_;
  for (std::size_t j = 0; j < count; ++j) {
    Crossing& f = crossings_[j];
    const Whole past = f.value - (Whole{f.plane} << bits_);  // the plane
    if (f.way > 0) {
      ++f.plane;
      f.next = unit - past;
    } else if (f.way < 0) {
      if (past == 0) --f.plane;
      f.next = past == 0 ? unit : past;
    }
  }
  for (;;) {
    Time time{1, 1};
    on = within;
    for (std::size_t j = 0; j < count; ++j) {
      const Crossing& f = crossings_[j];
      if (f.way == 0 || f.next > f.speed) continue;
      const Wide order = Wide(f.next) * time.denominator - Wide(time.numerator) * f.speed;
      if (order > 0) continue;
      if (order < 0) {
        time = {f.next, f.speed};
        on = within;
      }
      on |= 1u << j;
    }
    if (time.numerator == time.denominator) break;
    if (!pass(time)) return truth_;
    for (unsigned rest = on & ~within; rest; rest &= rest - 1) {
      Crossing& f = crossings_[static_cast<std::size_t>(std::countr_zero(rest))];
      f.next += unit;
      f.plane = static_cast<std::int16_t>(f.plane + (f.way > 0 ? 1 : -1));
    }
  }
  truth_.arrives = true;
  truth_.dimension = lattice_.dimension(on);
  truth_.degenerate |= truth_.dimension < D;
  at_end_ = on;
  return truth_;
}

template <int D>
bool Walk_judge<D>::leads_on(std::uint32_t cell, unsigned on,
                             const std::array<std::int16_t, most_families>& planes,
                             const std::array<Whole, most_families>& ways) {
  for (unsigned rest = on; rest; rest &= rest - 1) {
    const auto j = static_cast<std::size_t>(std::countr_zero(rest));
    crossings_[j].plane = planes[j];
    crossings_[j].way = ways[j];
  }
  cells_.assign(1, cell);
  link(on);
  return enter(on);
}

template <int D>
std::span<const std::uint32_t> Walk_judge<D>::linked_with(std::uint32_t cell) {
  cells_.assign(1, cell);
  link(at_end_);
  return linked_;
}

template <int D>
bool Walk_judge<D>::leads_out_at_end(const Side& side) const {
  return is_at(side, at_end_) && side.outwards * crossings_[side.family].way > 0;
}

template <int D>
Walk_fault fault_of(const World<D>& world, Walk_judge<D>& judge, const Walk_truth& truth,
                    const Walk_motion<D>& motion, const Walk_result<D>& result) {
  const Lattice<D>& lattice = world.lattice;
  const std::uint32_t cell = world.snapshot().index(result.cell);
  if (result.status == Walk_status::arrived) {
    if (!truth.arrives) return Walk_fault::missed_wall;
    if (!judge.may_end_in(cell)) return Walk_fault::wrong_cell;
    return result.dimension == truth.dimension ? Walk_fault::none : Walk_fault::wrong_kind;
  }
  if (result.status != Walk_status::contact || truth.arrives) return Walk_fault::false_contact;
  const Contact<D>& contact = *result.contact;
  if (!is_rounded(contact.time, truth.end)) return Walk_fault::wrong_time;
  double step = 0;
  for (std::size_t i = 0; i < D; ++i) {
    const double way = motion.to[i] - motion.from[i];
    const double size = std::max(std::abs(motion.from[i]), std::abs(motion.to[i]));
    if (!(std::abs(contact.point[i] - (motion.from[i] + contact.time * way)) <= 0x1p-50 * size))
      return Walk_fault::wrong_time;
    step += contact.normal[i] * way;
  }
  if (contact.cell != result.cell || !judge.may_end_in(cell)) return Walk_fault::wrong_cell;
  const Contact_kind kind = truth.dimension == 0       ? Contact_kind::vertex
                            : truth.dimension == D - 1 ? Contact_kind::facet
                                                       : Contact_kind::edge;
  if (contact.kind != kind) return Walk_fault::wrong_kind;
  if (to_index(contact.facet) >= world.side_of.size()) return Walk_fault::wrong_wall;
  const std::uint32_t number = world.side_of[to_index(contact.facet)];
  if (number == no_cell || !lattice.is_wall(number) || !judge.leads_out_at_end(lattice.side(number)))
    return Walk_fault::wrong_wall;
  const auto linked = judge.linked_with(cell);
  if (std::find(linked.begin(), linked.end(), lattice.cell_of(number)) == linked.end())
    return Walk_fault::wrong_wall;
  constexpr double rounding = 1e-9;
  const Side& side = lattice.side(number);
  const Vector<D> off = contact.normal + static_cast<double>(side.outwards) * world.normals[side.family];
  return dot(off, off) < rounding * rounding && step < 0 ? Walk_fault::none : Walk_fault::wrong_normal;
}

template class Walk_judge<2>;
template class Walk_judge<3>;
template Walk_fault fault_of(const World<2>&, Walk_judge<2>&, const Walk_truth&, const Walk_motion<2>&,
                             const Walk_result<2>&);
template Walk_fault fault_of(const World<3>&, Walk_judge<3>&, const Walk_truth&, const Walk_motion<3>&,
                             const Walk_result<3>&);

}  // namespace cellwalk::endurance
