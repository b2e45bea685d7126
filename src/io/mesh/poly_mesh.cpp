// SPDX-License-Identifier: LGPL-3.0-or-later
// Cells gathered from the faces that they own or neighbour, with names for facets and cells.
#include "poly_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

#include "element_groups.h"
#include "foam_lists.h"
#include "foam_patches.h"
#include "foam_reader.h"
#include "io/files/text.h"

namespace cellwalk::io {
namespace {

using Numbers = std::vector<std::uint32_t>;

constexpr std::uint32_t no_number = 0xffffffff;
constexpr std::size_t fewest_facets = 4;  // of a cell

struct Cells_of_faces {
  Numbers owner, neighbour;  ///< the latter of faces between two cells, which come first
  std::size_t cell_count = 0;
};

Cells_of_faces read_cells_of_faces(const Poly_mesh_files& files, std::size_t faces) {
  Cells_of_faces cells;
  Foam_reader owners(files.owner.name, files.owner.bytes);
  const auto most_cells = static_cast<std::int64_t>(std::max<std::size_t>(2 * faces / fewest_facets, 1));
  cells.owner = read_labels(owners, {"owners of faces", 0, most_cells}, faces);
  if (cells.owner.size() != faces)
    fail(files.owner.name,
         fmt::format("holds {} owners of faces, and there are {} faces: it is cut short, or "
                     "of another mesh",
                     cells.owner.size(), faces));
  Foam_reader neighbours(files.neighbour.name, files.neighbour.bytes);
  cells.neighbour = read_labels(neighbours, {"neighbours of faces", -1, most_cells}, faces);
  if (cells.neighbour.size() > faces)
    fail(files.neighbour.name,
         fmt::format("holds {} neighbours of faces, and there are {} faces: it is of another mesh",
                     cells.neighbour.size(), faces));
  // Old versions have -1 for each face of the boundary.
  while (!cells.neighbour.empty() && cells.neighbour.back() == no_number) cells.neighbour.pop_back();
  for (std::size_t f = 0; f < cells.neighbour.size(); ++f) {
    if (cells.neighbour[f] == no_number)
      fail(files.neighbour.name,
           fmt::format("face {} has no neighbour, and faces after it have: renumberMesh puts them in order",
                       f));
    if (cells.owner[f] >= cells.neighbour[f])
      fail(files.neighbour.name,
           fmt::format("face {} has owner {} and neighbour {}: an owner is the lower of two cells; "
                       "renumberMesh puts them in order",
                       f, cells.owner[f], cells.neighbour[f]));
  }
  for (const Numbers* of_faces : {&cells.owner, &cells.neighbour})
    for (const std::uint32_t c : *of_faces) cells.cell_count = std::max(cells.cell_count, std::size_t{c} + 1);
  const std::size_t facets = faces + cells.neighbour.size();
  if (cells.cell_count > facets / fewest_facets)
    fail(files.owner.name,
         fmt::format("names cell {}, and {} faces bound at most {} cells: it is of another mesh",
                     cells.cell_count - 1, faces, facets / fewest_facets));
  return cells;
}

/// A cell soup of all faces, with the numbers of their half-facets.
class Gathered_cells {
 public:
  Gathered_cells(const std::string& name, const Foam_faces& faces, const Cells_of_faces& cells)
      : faces_(faces), sides_(2 * faces.size(), no_number), first_boundary_(cells.neighbour.size()) {
    std::vector<std::size_t> begin(cells.cell_count + 1);
    for (const Numbers* of_faces : {&cells.owner, &cells.neighbour})
      for (const std::uint32_t c : *of_faces) ++begin[c + 1];
    for (std::size_t c = 0; c < cells.cell_count; ++c) {
      if (begin[c + 1] < fewest_facets)
        fail(name, fmt::format("cell {} has {} faces: at least 4 are needed", c, begin[c + 1]));
      begin[c + 1] += begin[c];
    }
    std::vector<std::size_t> sides(begin.back()), next(begin.begin(), begin.end() - 1);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      sides[next[cells.owner[f]]++] = 2 * f;
      if (f < first_boundary_) sides[next[cells.neighbour[f]]++] = 2 * f + 1;
    }
    for (std::size_t c = 0; c < cells.cell_count; ++c) {
      for (std::size_t i = begin[c]; i < begin[c + 1]; ++i) add(name, sides[i]);
      soup_.end_cell();
    }
  }

  /// The half-facets of a face: one on the boundary, otherwise two.
  void append_sides(std::size_t face, Numbers& to) const {
    to.push_back(sides_[2 * face]);
    if (face < first_boundary_) to.push_back(sides_[2 * face + 1]);
  }

  Cell_soup<3> take() { return std::move(soup_); }

 private:
  /// A face as its owner sees it, or as its neighbour does.
  void add(const std::string& name, std::size_t side) {
    const std::size_t face = side / 2;
    if (soup_.vertices.size() + faces_[face].size() >= no_number)
      fail(name, "the mesh is too large for 32-bit indices");
    sides_[side] = static_cast<std::uint32_t>(soup_.facet_count());
    loop_.assign(faces_[face].begin(), faces_[face].end());
    if (side % 2 == 1) std::reverse(loop_.begin() + 1, loop_.end());
    soup_.add_facet(loop_, face >= first_boundary_);
  }

  const Foam_faces& faces_;
  Cell_soup<3> soup_;
  Numbers sides_, loop_;
  std::size_t first_boundary_;
};

/// Pairs of boundary faces with the same points.
std::size_t baffle_count(const Foam_faces& faces, std::size_t first_boundary) {
  std::vector<Numbers> sorted;
  for (std::size_t f = first_boundary; f < faces.size(); ++f) {
    sorted.emplace_back(faces[f].begin(), faces[f].end());
    std::ranges::sort(sorted.back());
  }
  std::ranges::sort(sorted);
  std::size_t count = 0;
  for (auto it = sorted.begin(); (it = std::adjacent_find(it, sorted.end())) != sorted.end(); it += 2)
    ++count;
  return count;
}

std::string names_and_faces(const std::vector<const Foam_patch*>& patches) {
  constexpr std::size_t named = 12;
  std::string names;
  std::size_t faces = 0;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (i < named) names += (i == 0 ? "" : ", ") + shown(patches[i]->name);
    faces += patches[i]->size;
  }
  return fmt::format("{}{} ({} faces)", names, patches.size() > named ? " and others" : "", faces);
}

/// What is to be known of patches that a solver does not take for walls.
void note_patches(const std::vector<Foam_patch>& patches, Read_report& report) {
  std::vector<const Foam_patch*> cyclic, processor, flat;
  for (const Foam_patch& patch : patches) {
    if (patch.type.starts_with("processor"))
      processor.push_back(&patch);
    else if (lower(patch.type).find("cyclic") != std::string::npos)
      cyclic.push_back(&patch);
    else if (patch.type == "empty" || patch.type == "wedge")
      flat.push_back(&patch);
  }
  if (!cyclic.empty())
    report.notes.push_back(
        fmt::format("cyclic patches are walls, not passages: {}", names_and_faces(cyclic)));
  if (!processor.empty())
    report.notes.push_back(
        fmt::format("patches to other processors are walls: {}; reconstructParMesh puts the parts together",
                    names_and_faces(processor)));
  if (!flat.empty())
    report.notes.push_back(
        fmt::format("a case of two dimensions, read as a layer of 3D cells: {}", names_and_faces(flat)));
}

class Group_maker {
 public:
  explicit Group_maker(Mesh_file& file) : file_(file) {}

  /// The group of a name, with a note if the name is changed or had already.
  Soup_group& group(const std::string& name) {
    const std::string known = group_name(name);
    if (known != name) note(fmt::format("group \"{}\" named \"{}\"", shown(name), shown(known)));
    const auto [group, is_new] = file_.groups.try_emplace(known);
    if (!is_new) note(fmt::format("group \"{}\": several patches or zones of this name", shown(known)));
    return group->second;
  }

  /// Sorts the members, and drops groups without any.
  void finish() {
    for (auto group = file_.groups.begin(); group != file_.groups.end();) {
      for (Numbers* members : {&group->second.facets, &group->second.cells}) {
        std::ranges::sort(*members);
        members->erase(std::unique(members->begin(), members->end()), members->end());
      }
      const bool is_empty = group->second.facets.empty() && group->second.cells.empty();
      group = is_empty ? file_.groups.erase(group) : std::next(group);
    }
  }

 private:
  void note(std::string text) { file_.report.notes.push_back(std::move(text)); }

  Mesh_file& file_;
};

void make_groups(const Poly_mesh_files& files, const std::vector<Foam_patch>& patches,
                 const Gathered_cells& cells, std::size_t faces, std::size_t cell_count, Mesh_file& file) {
  Group_maker groups(file);
  for (const Foam_patch& patch : patches) {
    Numbers& facets = groups.group(patch.name).facets;
    for (std::size_t f = patch.first; f < patch.first + patch.size; ++f) cells.append_sides(f, facets);
  }
  if (files.face_zones) {
    Foam_reader in(files.face_zones->name, files.face_zones->bytes);
    const Label_range range{"faces of a zone", 0, static_cast<std::int64_t>(faces)};
    for (const Foam_zone& zone : read_foam_zones(in, "faceLabels", range)) {
      Numbers& facets = groups.group(zone.name).facets;
      for (const std::uint32_t f : zone.members) cells.append_sides(f, facets);
    }
  }
  if (files.cell_zones) {
    Foam_reader in(files.cell_zones->name, files.cell_zones->bytes);
    const Label_range range{"cells of a zone", 0, static_cast<std::int64_t>(cell_count)};
    for (const Foam_zone& zone : read_foam_zones(in, "cellLabels", range)) {
      Numbers& members = groups.group(zone.name).cells;
      members.insert(members.end(), zone.members.begin(), zone.members.end());
    }
  }
  groups.finish();
}

}  // namespace

Mesh_file parse_poly_mesh(const Poly_mesh_files& files) {
  Foam_reader points_file(files.points.name, files.points.bytes);
  std::vector<Point<3>> points = read_foam_points(points_file);
  if (points.empty()) points_file.fail("holds no points");
  Foam_reader faces_file(files.faces.name, files.faces.bytes);
  const Foam_faces faces = read_foam_faces(faces_file, points.size());
  if (faces.size() == 0) faces_file.fail("holds no faces");
  const Cells_of_faces owners = read_cells_of_faces(files, faces.size());
  const std::size_t first_boundary = owners.neighbour.size();
  Foam_reader boundary(files.boundary.name, files.boundary.bytes);
  const std::vector<Foam_patch> patches = read_foam_patches(boundary, first_boundary, faces.size());

  Mesh_file file{Mesh{}, {}, {}};
  file.report.format = fmt::format("OpenFOAM polyMesh{}", faces_file.is_binary() ? " (binary)" : "");
  note_patches(patches, file.report);
  std::size_t in_no_patch = faces.size() - first_boundary;
  for (const Foam_patch& patch : patches) in_no_patch -= patch.size;
  if (in_no_patch > 0)
    file.report.notes.push_back(fmt::format("{} boundary faces are in no patch", in_no_patch));
  if (const std::size_t baffles = baffle_count(faces, first_boundary); baffles > 0)
    file.report.notes.push_back(
        fmt::format("{} pair{} of boundary faces with the same points, read as walls (baffles)", baffles,
                    baffles > 1 ? "s" : ""));

  Gathered_cells cells(files.owner.name, faces, owners);
  make_groups(files, patches, cells, faces.size(), owners.cell_count, file);
  Cell_soup<3> soup = cells.take();
  soup.points = std::move(points);
  file.report.points = soup.points.size();
  file.report.cells = soup.cell_count();
  file.report.facets = soup.facet_count();
  file.mesh = std::move(soup);
  return file;
}

}  // namespace cellwalk::io
