// SPDX-License-Identifier: LGPL-3.0-or-later
#include "flights.h"

#include <cellwalk/internal/io/csv.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "common/confidence.h"
#include "common/seeds.h"
#include "common/shared.h"
#include "failures.h"
#include "tally.h"

namespace cellwalk::exact_float {
namespace {

constexpr std::size_t particle_count = 16;
constexpr double step_length = 0.3;      // cells
constexpr std::size_t path_length = 12;  // positions kept for a picture

/// What became of one kernel.
struct Flown {
  std::uint64_t moves = 0, first_escape = 0;  ///< number of the move, from 1; 0: none
  std::uint64_t escapes = 0, contacts = 0;
  std::uint64_t held = 0;  ///< contacts whose rounded point could not be reached
  Tally tally{};           ///< of all walks
  double energy = 0;       ///< mean of all particles at the end, as a share of that at the start
};

template <int D>
struct Flyer {
  Particle<D> particle;
  Vector<D> velocity;
  std::vector<Point<D>> path;
};

template <int D>
class Flight_trial {
 public:
  Flight_trial(const Kernel<D>& kernel, const Run_options& options)
      : kernel_(kernel),
        folder_(options.folder),
        seed_(experiments::part_seed(options.seed, fmt::format("flights {}", D))),
        random_(seed_),
        scene_(make_world<D>({}, seed_)) {}

  Flown run(std::uint64_t moves) {
    std::vector<Flyer<D>> flyers;
    for (std::size_t i = 0; i < particle_count; ++i) flyers.push_back(flyer());
    while (flown_.moves < moves) move(flyers[flown_.moves % particle_count]);
    for (const Flyer<D>& f : flyers) flown_.energy += dot(f.velocity, f.velocity);
    flown_.energy /= particle_count * step_length * step_length;
    return flown_;
  }

 private:
  Flyer<D> flyer() {
    Flyer<D> f;
    f.particle = start();
    double size = 0;
    do {
      for (double& x : f.velocity) x = random_.real(-1, 1);
      size = length(f.velocity);
    } while (size < 0.1);
    f.velocity = (step_length / size) * f.velocity;
    return f;
  }

  /// Anywhere in free space.
  Particle<D> start() {
    for (;;) {
      Point<D> k;
      for (int i = 0; i < D; ++i) k[i] = random_.real(0, scene_.world.cells[i]);
      if (const auto particle = scene_.particle_at(scene_.world.map(k), random_)) return *particle;
    }
  }

  void move(Flyer<D>& f) {
    ++flown_.moves;
    f.path.push_back(f.particle.position);
    if (f.path.size() > path_length) f.path.erase(f.path.begin());
    const Walk_result<D> result = walk(f, f.particle.position + f.velocity);
    if (result.status == Walk_status::lost) {
      f.velocity = -1 * f.velocity;
    } else if (result.contact) {
      ++flown_.contacts;
      flown_.held += walk(f, result.contact->point).status != Walk_status::arrived;
      const Vector<D>& n = result.contact->normal;
      f.velocity = f.velocity - (2 * dot(f.velocity, n)) * n;
    }
  }

  /// Walks by the kernel, judges, and moves the particle if the walk arrives.
  Walk_result<D> walk(Flyer<D>& f, const Point<D>& to) {
    const oracle::Case<D> motion = scene_.motion_of(f.particle, to);
    std::vector<Cell> visited;
    Walk_counts counts;
    const Walk_result<D> result =
        kernel_.walk(scene_.snapshot, f.particle, to, counts, kernel_.strategy, {&visited});
    const Outcome outcome = outcome_of(scene_.oracle, scene_.snapshot, motion, result, visited);
    ++flown_.tally[static_cast<std::size_t>(outcome)];
    if (result.status != Walk_status::arrived) return result;
    const auto& ends = motion.truth.arrivals;
    if (std::find(ends.begin(), ends.end(), scene_.snapshot.index(result.cell)) == ends.end()) {
      escape(f, to);
      return result;
    }
    f.particle = {to, result.cell, result.dimension, 0};
    return result;
  }

  /// Where no legal walk leads, in space or only by its cell. The particle is put back.
  void escape(Flyer<D>& f, const Point<D>& to) {
    if (++flown_.escapes == 1) {
      flown_.first_escape = flown_.moves;
      const std::string name = fmt::format("escape_{}d_{}", D, kernel_.name);
      if (kernel_.policy)
        write_failure(folder_ / (name + ".json"), scene_, kernel_, f.particle, to,
                      fmt::format("{}: escapes at move {}", kernel_.name, flown_.moves));
      if constexpr (D == 2) write_picture(name, f, to);
    }
    f.particle = start();
    f.path.clear();
  }

  /// The way that led there, and the walls.
  void write_picture(const std::string& name, const Flyer<2>& f, const Point<2>& to) const {
    io::Csv_writer path(folder_ / (name + "_path.csv"), {"x", "y"});
    for (const Point<2>& p : f.path) path.row(p[0], p[1]);
    if (f.path.back() != f.particle.position) path.row(f.particle.position[0], f.particle.position[1]);
    path.row(to[0], to[1]);
    path.commit();
    io::Csv_writer walls(folder_ / (name + "_walls.csv"), {"ax", "ay", "bx", "by"});
    const Snapshot<2>& s = scene_.snapshot;
    for (std::size_t c = 0; c < s.cell_count(); ++c)
      for (std::size_t i = 0; i < s.facet_count(s.cell(c)); ++i) {
        const Half_facet h = Snapshot<2>::half_facet(s.cell(c), i);
        if (!s.is_impassable(h)) continue;
        const Point<2>&a = s.point(s.loop(h)[0]), &b = s.point(s.loop(h)[1]);
        walls.row(a[0], a[1], b[0], b[1]);
      }
    walls.commit();
  }

  const Kernel<D> kernel_;
  const std::filesystem::path folder_;
  const std::uint64_t seed_;
  Random random_;
  const Scene<D> scene_;
  Flown flown_;
};

void write_row(io::Csv_writer& table, int dimension, const char* kernel, const Flown& f) {
  constexpr double million = 1e6;
  const auto interval = experiments::confidence_interval(f.escapes, f.moves);
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  const Tally& t = f.tally;
  table.row(dimension, kernel, f.moves, f.first_escape ? static_cast<double>(f.first_escape) : nothing,
            f.escapes, million * static_cast<double>(f.escapes) / static_cast<double>(f.moves),
            million * interval.low, million * interval.high, f.contacts, f.held, f.energy, total(t), wrong(t),
            t[1], t[2], t[3], t[4], t[5], t[6], t[7], t[8], t[9], t[10]);
}

}  // namespace

Exact_summary run_flights(const Run_options& options) {
  const auto in_plane = kernels<2>();
  const auto in_space = kernels<3>();
  const auto flown = experiments::shared_trials(2 * kernel_count, [&](std::size_t i) {
    return i < kernel_count ? Flight_trial<2>(in_plane[i], options).run(options.count)
                            : Flight_trial<3>(in_space[i - kernel_count], options).run(options.count);
  });
  experiments::gather_files(options.folder, "escape_");
  std::vector<std::string> columns{
      "dimension", "kernel", "moves",  "first_escape", "escapes", "escapes_per_million", "low", "high",
      "contacts",  "held",   "energy", "motions",      "wrong"};
  columns.insert(columns.end(), outcome_names.begin() + 1, outcome_names.end());
  io::Csv_writer table(options.folder / "flights.csv", columns);
  Exact_summary summary;
  for (std::size_t i = 0; i < flown.size(); ++i) {
    const auto& kernel = in_plane[i % kernel_count];
    write_row(table, i < kernel_count ? 2 : 3, kernel.name, flown[i]);
    fmt::print("flights {}D {}: {} escapes in {} moves, {} of {} walks wrong\n", i < kernel_count ? 2 : 3,
               kernel.name, flown[i].escapes, flown[i].moves, wrong(flown[i].tally), total(flown[i].tally));
    summary.motions += flown[i].moves;
    if (!kernel.is_exact) continue;
    summary.by_exact += total(flown[i].tally);
    summary.wrong += wrong(flown[i].tally);
  }
  table.commit();
  return summary;
}

}  // namespace cellwalk::exact_float
