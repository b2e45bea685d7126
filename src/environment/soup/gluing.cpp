// SPDX-License-Identifier: LGPL-3.0-or-later
// Half-facets are put into buckets by their lowest vertex (counting sort), then sorted in each bucket by
// their second lowest and highest vertices: for triangles that is the whole vertex set. Buckets are small,
// and are matched in parallel.
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/kernel/error.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <optional>
#include <string>

namespace cellwalk {
namespace {

using Loop = std::span<const std::uint32_t>;

/// A half-facet in the bucket of its lowest vertex.
struct Record {
  std::uint64_t rest;   ///< second lowest vertex, then highest
  std::uint32_t facet;  ///< the half-facet
  bool is_simplex;      ///< D vertices: lowest and rest are the vertex set
  bool is_ascending;    ///< of a simplex: in the loop, the second lowest vertex follows the lowest
};

/// The reason why two half-facets exclude each other.
struct Conflict {
  enum class Kind { crowded, same_side, different_order, slit } kind;
  std::uint32_t first, second;
};

/// The lowest i in [0, n) for which fails(i), or n: the same for any number of threads.
template <class Predicate>
std::size_t first_failure(std::size_t n, const Predicate& fails) {
  std::atomic<std::size_t> first{n};
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      if (!fails(i)) continue;
      std::size_t known = first.load();
      while (i < known && !first.compare_exchange_weak(known, i)) {
      }
      return;
    }
  });
  return first;
}

template <int D>
std::size_t cell_of_facet(const Cell_soup<D>& soup, std::size_t f) {
  return std::upper_bound(soup.cell_begin.begin(), soup.cell_begin.end(), f) - soup.cell_begin.begin() - 1;
}

template <int D>
std::string name(const Cell_soup<D>& soup, std::size_t f) {
  const std::size_t c = cell_of_facet(soup, f);
  return "facet " + std::to_string(f - soup.cell_begin[c]) + " of cell " + std::to_string(c);
}

bool has_repeated_vertex(Loop loop) {
  if (loop.size() <= 16) {
    for (std::size_t i = 1; i < loop.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (loop[i] == loop[j]) return true;
    return false;
  }
  std::vector<std::uint32_t> sorted(loop.begin(), loop.end());
  std::sort(sorted.begin(), sorted.end());
  return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

template <int D>
bool is_loop_size(std::size_t n) {
  return D == 2 ? n == 2 : n >= 3;
}

/// Checks that the lengths of the arrays agree, and that rows do not run backwards.
template <int D>
void check_arrays(const Cell_soup<D>& soup) {
  const auto is_row_index = [](const std::vector<std::uint32_t>& begin, std::size_t end) {
    return !begin.empty() && begin.front() == 0 && begin.back() == end &&
           std::is_sorted(begin.begin(), begin.end());
  };
  if (!is_row_index(soup.facet_begin, soup.vertices.size()) ||
      !is_row_index(soup.cell_begin, soup.facet_count()) || soup.impassable.size() != soup.facet_count() ||
      soup.solid.size() != soup.cell_count())
    throw Error(Error_code::input,
                "the arrays of the cell soup do not agree in length: build it with add_facet and end_cell");
}

/// \throw Error(input) for the first malformed half-facet
template <int D>
void check_loops(const Cell_soup<D>& soup) {
  const auto is_out_of_range = [&](std::uint32_t v) { return v >= soup.points.size(); };
  const std::size_t f = first_failure(soup.facet_count(), [&](std::size_t i) {
    const Loop loop = soup.facet(i);
    return !is_loop_size<D>(loop.size()) || std::any_of(loop.begin(), loop.end(), is_out_of_range) ||
           has_repeated_vertex(loop);
  });
  if (f == soup.facet_count()) return;
  const Loop loop = soup.facet(f);
  std::string what = name(soup, f);
  const auto bad = std::find_if(loop.begin(), loop.end(), is_out_of_range);
  if (bad != loop.end())
    what += " refers to point " + std::to_string(*bad) + ", but there are only " +
            std::to_string(soup.points.size()) + " (indices start at 0)";
  else if (!is_loop_size<D>(loop.size()))
    what += " has " + std::to_string(loop.size()) +
            (D == 2 ? " vertices; an edge has 2" : " vertices; it needs 3");
  else
    what += " has a vertex twice: remove the repetition";
  throw Error(Error_code::input, what);
}

template <int D>
Record make_record(Loop loop, std::uint32_t lowest, std::size_t facet) {
  std::uint32_t second = 0xffffffffu, highest = 0;
  for (std::uint32_t v : loop) {
    highest = std::max(highest, v);
    if (v != lowest) second = std::min(second, v);
  }
  const std::size_t at = std::find(loop.begin(), loop.end(), lowest) - loop.begin();
  // An edge has no rotations: (u,v) is one direction, (v,u) the other.
  const bool ascending = D == 2 ? at == 0 : loop[(at + 1) % loop.size()] == second;
  return {std::uint64_t{second} << 32 | highest, static_cast<std::uint32_t>(facet), loop.size() == D,
          ascending};
}

/// \pre a and b have the same vertex set
/// Returns +1 if the loops are the same up to rotation, -1 if one is the reverse of the other, 0 if neither.
int compare_loops(Loop a, Loop b) {
  const std::size_t n = a.size();
  const std::size_t start = std::find(b.begin(), b.end(), a[0]) - b.begin();
  const auto agrees = [&](std::size_t step) {
    for (std::size_t i = 0, j = start; i < n; ++i, j = (j + step) % n)
      if (a[i] != b[j]) return false;
    return true;
  };
  if (agrees(n - 1)) return -1;
  return agrees(1) ? 1 : 0;
}

template <int D>
class Matcher {
 public:
  Matcher(const Cell_soup<D>& soup, std::vector<std::uint32_t>& opposite)
      : soup_(soup), opposite_(opposite) {}

  /// Matches the half-facets of one bucket.
  std::optional<Conflict> match(std::span<Record> bucket) {
    const auto before = [](const Record& a, const Record& b) {
      return a.rest != b.rest ? a.rest < b.rest : a.facet < b.facet;
    };
    std::sort(bucket.begin(), bucket.end(), before);
    for (std::size_t i = 0, end = 0; i < bucket.size(); i = end) {
      bool simplices = true;
      for (end = i; end < bucket.size() && bucket[end].rest == bucket[i].rest; ++end)
        simplices &= bucket[end].is_simplex;
      const auto group = bucket.subspan(i, end - i);
      if (auto conflict = simplices ? match_equal(group) : match_polygons(group)) return conflict;
    }
    return {};
  }

 private:
  /// \pre all have the same vertex set
  std::optional<Conflict> match_equal(std::span<const Record> group) {
    if (group.size() == 1) return {};
    const std::uint32_t a = group[0].facet, b = group[1].facet;
    if (group.size() > 2) return Conflict{Conflict::Kind::crowded, a, group[2].facet};
    const int order = !group[0].is_simplex ? compare_loops(soup_.facet(a), soup_.facet(b))
                      : group[0].is_ascending == group[1].is_ascending ? 1
                                                                       : -1;
    if (order == 1) return Conflict{Conflict::Kind::same_side, a, b};
    if (order == 0) return Conflict{Conflict::Kind::different_order, a, b};
    opposite_[a] = b;
    opposite_[b] = a;
    return {};
  }

  /// Separates polygons that agree in three vertices only.
  std::optional<Conflict> match_polygons(std::span<Record> group) {
    if (group.size() == 1) return {};
    std::vector<std::pair<std::vector<std::uint32_t>, Record>> sorted;
    for (const Record& r : group) {
      const Loop loop = soup_.facet(r.facet);
      sorted.emplace_back(std::vector<std::uint32_t>(loop.begin(), loop.end()), r);
      std::sort(sorted.back().first.begin(), sorted.back().first.end());
    }
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 0; i < sorted.size(); ++i) group[i] = sorted[i].second;
    for (std::size_t i = 0, end = 0; i < sorted.size(); i = end) {
      for (end = i; end < sorted.size() && sorted[end].first == sorted[i].first;) ++end;
      if (auto conflict = match_equal(group.subspan(i, end - i))) return conflict;
    }
    return {};
  }

  const Cell_soup<D>& soup_;
  std::vector<std::uint32_t>& opposite_;
};

template <int D>
[[noreturn]] void refuse(const Cell_soup<D>& soup, const Conflict& conflict) {
  const std::string a = name(soup, conflict.first), b = name(soup, conflict.second);
  std::string what;
  switch (conflict.kind) {
    case Conflict::Kind::crowded:
      what = a + " and " + b + " share their vertices with a third cell: at most two cells may share a facet";
      break;
    case Conflict::Kind::same_side:
      what = a + " and " + b + " lie on the same side of it: one of the cells is inverted or given twice";
      break;
    case Conflict::Kind::different_order:
      what = a + " and " + b + " have the same vertices in a different cyclic order: correct one of them";
      break;
    case Conflict::Kind::slit:
      what =
          a + " is also its " + b.substr(0, b.find(" of")) + ", seen from behind: a cell cannot touch itself";
      break;
  }
  throw Error(Error_code::not_certified, what);
}

/// Buckets all half-facets by their lowest vertex; begin[v] is the start of bucket v.
template <int D>
std::vector<Record> bucket_by_lowest(const Cell_soup<D>& soup, std::vector<std::uint32_t>& begin) {
  const std::size_t n = soup.facet_count();
  std::vector<std::uint32_t> lowest(n);
  begin.assign(soup.points.size() + 1, 0);
  for (std::size_t f = 0; f < n; ++f) {
    const Loop loop = soup.facet(f);
    lowest[f] = *std::min_element(loop.begin(), loop.end());
    ++begin[lowest[f] + 1];
  }
  for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  std::vector<Record> records(n);
  for (std::size_t f = 0; f < n; ++f)
    records[next[lowest[f]]++] = make_record<D>(soup.facet(f), lowest[f], f);
  return records;
}

/// \throw Error(not_certified) for the first cell that is glued to itself
template <int D>
void check_slits(const Cell_soup<D>& soup, const Gluing& gluing) {
  for (std::size_t c = 0; c < soup.cell_count(); ++c)
    for (std::uint32_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f)
      if (gluing.opposite[f] >= soup.cell_begin[c] && gluing.opposite[f] < soup.cell_begin[c + 1])
        refuse(soup, {Conflict::Kind::slit, f, gluing.opposite[f]});
}

}  // namespace

template <int D>
void check_soup(const Cell_soup<D>& soup) {
  check_arrays(soup);
  check_loops(soup);
}

template <int D>
Gluing glue(const Cell_soup<D>& soup) {
  check_soup(soup);
  std::vector<std::uint32_t> begin;
  std::vector<Record> records = bucket_by_lowest(soup, begin);
  Gluing gluing{std::vector<std::uint32_t>(soup.facet_count(), no_facet)};
  const auto match = [&](std::size_t v) {
    return Matcher<D>(soup, gluing.opposite)
        .match({records.data() + begin[v], records.data() + begin[v + 1]});
  };
  const std::size_t bad =
      first_failure(soup.points.size(), [&](std::size_t v) { return match(v).has_value(); });
  if (bad != soup.points.size()) refuse(soup, *match(bad));
  check_slits(soup, gluing);
  return gluing;
}

template void check_soup(const Cell_soup<2>&);
template void check_soup(const Cell_soup<3>&);
template Gluing glue(const Cell_soup<2>&);
template Gluing glue(const Cell_soup<3>&);

}  // namespace cellwalk
