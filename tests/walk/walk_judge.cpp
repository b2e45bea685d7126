// SPDX-License-Identifier: LGPL-3.0-or-later
#include "walk/walk_judge.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace cellwalk::oracle {
namespace {

/// The number in the oracle's soup of a half-facet of the snapshot (which may number the facets of a cell
/// otherwise).
template <int D>
int facet_in_soup(const Oracle<D>& oracle, const Snapshot<D>& snapshot, Half_facet f) {
  std::vector<std::uint32_t> wanted = snapshot.loop(f);
  std::sort(wanted.begin(), wanted.end());
  const Cell_soup<D>& soup = oracle.soup();
  const std::uint32_t cell = snapshot.index(snapshot.cell_of(f));
  for (std::uint32_t g = soup.cell_begin[cell]; g < soup.cell_begin[cell + 1]; ++g) {
    std::vector<std::uint32_t> loop(soup.facet(g).begin(), soup.facet(g).end());
    std::sort(loop.begin(), loop.end());
    if (loop == wanted) return static_cast<int>(g - soup.cell_begin[cell]);
  }
  return -1;
}

/// The wall named by a contact must be one of a cell linked with the last one at the point, and hold the
/// point.
template <int D>
bool is_right_wall(const Oracle<D>& oracle, const Snapshot<D>& snapshot, const Trace& trace, const Stop& stop,
                   Half_facet wall) {
  if (wall == Half_facet::none) return false;
  const int facet = facet_in_soup(oracle, snapshot, wall);
  const std::vector<int> classes = trace.classes_at(stop.event);
  const int here = trace.visit_of(stop.cell);
  return std::any_of(trace.incidences.begin(), trace.incidences.end(), [&](const Incidence& i) {
    return !i.passable && i.first <= stop.event && stop.event <= i.last &&
           static_cast<int>(i.facet) == facet &&
           trace.visits[i.visit].cell == snapshot.index(snapshot.cell_of(wall)) &&
           classes[i.visit] == classes[here];
  });
}

template <int D>
bool is_right_normal(const Snapshot<D>& snapshot, const Case<D>& motion, const Contact<D>& contact) {
  constexpr double rounding = 1e-9;  // generous: normals are rounded, this is not about exactness
  const Vector<D> step = motion.to - motion.from;
  if (std::abs(length(contact.normal) - 1) > rounding) return false;
  if (dot(contact.normal, step) >= rounding * length(step)) return false;
  const std::vector<std::uint32_t> loop = snapshot.loop(contact.facet);
  for (std::size_t i = 0; i + 1 < loop.size(); ++i) {
    const Vector<D> edge = snapshot.point(loop[i + 1]) - snapshot.point(loop[i]);
    if (std::abs(dot(contact.normal, edge)) > rounding * length(edge)) return false;
  }
  return true;
}

template <int D>
bool is_right_point(const Case<D>& motion, const Contact<D>& contact) {
  for (int i = 0; i < D; ++i) {
    const double expected = motion.from[i] + contact.time * (motion.to[i] - motion.from[i]);
    const double size = std::max(std::abs(motion.from[i]), std::abs(motion.to[i]));
    if (std::abs(contact.point[i] - expected) > 4 * 0x1p-52 * size) return false;
  }
  return true;
}

double rounded(const Fraction<Wide>& t) {
  return static_cast<double>(boost::multiprecision::cpp_rational(t.numerator, t.denominator));
}

template <int D>
Verdict judge_contact(const Oracle<D>& oracle, const Snapshot<D>& snapshot, const Case<D>& motion,
                      const Walk_result<D>& result, Sides_due sides) {
  const Truth& truth = motion.truth;
  const bool may_arrive = !truth.arrivals.empty();
  if (truth.stops.empty() || (may_arrive && sides == Sides_due::furthest)) return Verdict::false_contact;
  const std::uint32_t cell = snapshot.index(result.cell);
  const auto stop =
      std::find_if(truth.stops.begin(), truth.stops.end(), [&](const Stop& s) { return s.cell == cell; });
  if (stop == truth.stops.end()) {
    if (may_arrive) return Verdict::false_contact;
    // Stops are in order of time. Earlier than all is a false contact, later than all a wall passed.
    const double t = result.contact->time;
    const auto& earliest = motion.trace.events[truth.stops.front().event];
    const auto& latest = motion.trace.events[truth.stops.back().event];
    if (t > rounded(latest) && !is_within_4_ulp(t, latest)) return Verdict::missed_wall;
    if (t < rounded(earliest) && !is_within_4_ulp(t, earliest)) return Verdict::false_contact;
    return Verdict::wrong_cell;
  }
  if (sides == Sides_due::furthest && stop->event != truth.stops.back().event) return Verdict::false_contact;
  if (!is_within_4_ulp(result.contact->time, motion.trace.events[stop->event]) ||
      !is_right_point(motion, *result.contact))
    return Verdict::wrong_time;
  const Contact_kind kind = stop->dimension == 0       ? Contact_kind::vertex
                            : stop->dimension == D - 1 ? Contact_kind::facet
                                                       : Contact_kind::edge;
  if (result.contact->kind != kind) return Verdict::wrong_kind;
  if (result.contact->cell != result.cell) return Verdict::wrong_cell;
  if (!is_right_wall(oracle, snapshot, motion.trace, *stop, result.contact->facet))
    return Verdict::wrong_wall;
  if (!is_right_normal(snapshot, motion, *result.contact)) return Verdict::wrong_normal;
  return Verdict::right;
}

}  // namespace

const char* name(Verdict verdict) {
  static constexpr const char* names[] = {"right",      "lost",         "missed wall",    "false contact",
                                          "wrong cell", "illegal way",  "wrong time",     "wrong kind",
                                          "wrong wall", "wrong normal", "wrong dimension"};
  return names[static_cast<int>(verdict)];
}

bool is_within_4_ulp(double t, const Fraction<Wide>& exact) {
  using boost::multiprecision::cpp_int;
  const cpp_int n(exact.numerator), d(exact.denominator);
  const Dyadic dyadic = to_dyadic(t);
  if (dyadic.mantissa == 0) return n == 0;
  // |m 2^e - n/d| <= 4 2^u, everything times 2^s d so that it is whole.
  const int ulp = std::ilogb(t) - 52, s = std::max({0, -dyadic.exponent, -ulp});
  const cpp_int left = (cpp_int(dyadic.mantissa) << (dyadic.exponent + s)) * d - (n << s);
  return abs(left) <= (d << (ulp + s + 2));
}

template <int D>
Verdict judge_walk(const Oracle<D>& oracle, const Snapshot<D>& snapshot, const Case<D>& motion,
                   const Walk_result<D>& result, const std::vector<Cell>& visited, Sides_due sides) {
  const Truth& truth = motion.truth;
  if (result.status == Walk_status::lost) return Verdict::lost;
  if (result.status == Walk_status::contact) {
    const Verdict verdict = judge_contact(oracle, snapshot, motion, result, sides);
    if (verdict != Verdict::right) return verdict;
  } else {
    if (truth.arrivals.empty()) return Verdict::missed_wall;
    const std::uint32_t cell = snapshot.index(result.cell);
    if (std::find(truth.arrivals.begin(), truth.arrivals.end(), cell) == truth.arrivals.end())
      return Verdict::wrong_cell;
    if (result.dimension != motion.trace.visits[motion.trace.visit_of(cell)].dimension_at_last)
      return Verdict::wrong_dimension;
  }
  if (visited.empty()) return Verdict::right;
  std::vector<std::uint32_t> path;
  for (Cell c : visited) path.push_back(snapshot.index(c));
  if (visited.back() != result.cell || visited.size() != result.cells ||
      check_path(motion.trace, motion.start, path) != Path_fault::none)
    return Verdict::illegal_way;
  return Verdict::right;
}

template <int D>
std::string describe(const Case<D>& motion) {
  std::ostringstream text;
  text << "cell " << motion.start << std::hexfloat << " from";
  for (double x : motion.from) text << ' ' << x;
  text << " to";
  for (double x : motion.to) text << ' ' << x;
  text << "; legal arrivals:";
  for (std::uint32_t c : motion.truth.arrivals) text << ' ' << c;
  text << "; legal stops:";
  for (const Stop& s : motion.truth.stops) {
    const auto& t = motion.trace.events[s.event];
    text << " (cell " << s.cell << " dimension " << s.dimension << " time " << t.numerator << '/'
         << t.denominator << ')';
  }
  return text.str();
}

template Verdict judge_walk(const Oracle<2>&, const Snapshot<2>&, const Case<2>&, const Walk_result<2>&,
                            const std::vector<Cell>&, Sides_due);
template Verdict judge_walk(const Oracle<3>&, const Snapshot<3>&, const Case<3>&, const Walk_result<3>&,
                            const std::vector<Cell>&, Sides_due);
template std::string describe(const Case<2>&);
template std::string describe(const Case<3>&);

}  // namespace cellwalk::oracle
