// SPDX-License-Identifier: LGPL-3.0-or-later
// Meshes of OpenFOAM in every encoding, judged by volumes and closed cells; broken ones by their messages.
#include <cellwalk/internal/io/gzip.h>
#include <cellwalk/internal/io/mesh_files.h>
#include <cellwalk/io/body_file.h>
#include <cellwalk/io/mesh_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "foam_mesh.h"
#include "io/damaged.h"
#include "io/io_fixture.h"
#include "io/mesh/poly_mesh.h"
#include "volumes.h"

namespace cellwalk::io {
namespace {

namespace fs = std::filesystem;
using test::Foam_encoding;
using test::Foam_mesh;
using test::Foam_writer;
using Files = std::map<std::string, std::string>;
using Notes = std::vector<std::string>;

Mesh_file parse(const Files& files) {
  const auto named = [&](const std::string& name) { return Named_bytes{name, files.at(name)}; };
  const auto optional = [&](const std::string& name) {
    return files.contains(name) ? std::optional(named(name)) : std::nullopt;
  };
  return parse_poly_mesh({named("points"), named("faces"), named("owner"), named("neighbour"),
                          named("boundary"), optional("faceZones"), optional("cellZones")});
}

Mesh_file parse(const Foam_mesh& mesh, const Foam_encoding& encoding = {}) {
  return parse(Foam_writer(encoding).files(mesh));
}

const Cell_soup<3>& cells_of(const Mesh_file& file) { return std::get<Cell_soup<3>>(file.mesh); }

std::size_t wall_count(const Cell_soup<3>& soup) {
  return static_cast<std::size_t>(std::count(soup.impassable.begin(), soup.impassable.end(), 1));
}

const std::vector<Foam_encoding> encodings{{},
                                           {true, 32, 64},
                                           {true, 64, 64},
                                           {true, 32, 32},
                                           {true, 64, 32},
                                           {true, 32, 64, false},
                                           {true, 32, 64, true, false},
                                           {true, 64, 64, true, false},
                                           {true, 64, 32, false, false}};

TEST(PolyMesh, EveryEncodingHoldsTheSameCells) {
  const Foam_mesh mesh = test::foam_block(3);
  const Mesh_file first = parse(mesh);
  for (const Foam_encoding& encoding : encodings) {
    SCOPED_TRACE(Foam_writer(encoding).header("any", "any"));
    const Mesh_file file = parse(mesh, encoding);
    EXPECT_EQ(file.report.format, encoding.is_binary ? "OpenFOAM polyMesh (binary)" : "OpenFOAM polyMesh");
    EXPECT_EQ(file.report.notes, Notes{});
    EXPECT_EQ(file.report.points, 64u);
    EXPECT_EQ(file.report.cells, 26u);
    EXPECT_EQ(file.report.facets, 27u * 6 - 2);
    const Cell_soup<3>& soup = cells_of(file);
    std::vector<double> volumes(26, 6);  // sixths
    volumes[0] = 12;
    EXPECT_EQ(six_volumes(soup), volumes);
    EXPECT_EQ(soup.cell_begin[1], 10u) << "facets of the polyhedron";
    EXPECT_TRUE(all_closed(soup));
    EXPECT_EQ(shared_facets(soup), 53u);
    EXPECT_EQ(wall_count(soup), 54u);
    EXPECT_EQ(soup.points, cells_of(first).points);
    EXPECT_EQ(soup.vertices, cells_of(first).vertices);
    EXPECT_EQ(file.groups, first.groups);
  }
}

TEST(PolyMesh, PatchesAreGroupsOfTheirFacets) {
  const Mesh_file file = parse(test::foam_block(3));
  const Cell_soup<3>& soup = cells_of(file);
  ASSERT_EQ(file.groups.size(), 3u);
  EXPECT_EQ(file.groups.at("sides").facets.size(), 36u);
  for (const auto& [name, x] : {std::pair{"inlet", 0.}, std::pair{"outlet", 3.}}) {
    EXPECT_EQ(file.groups.at(name).facets.size(), 9u);
    for (const std::uint32_t f : file.groups.at(name).facets) {
      EXPECT_TRUE(soup.impassable[f]);
      for (const std::uint32_t v : soup.facet(f)) EXPECT_EQ(soup.points[v][0], x);
    }
  }
}

TEST(PolyMesh, IsFoundWhereverItIsNamed) {
  const Folder folder;
  const fs::path constant = folder / "constant";
  test::write_foam(constant / "polyMesh", Foam_writer().files(test::foam_block(2)));
  std::ofstream(folder / "a.foam") << "";
  for (const fs::path& path : {constant / "polyMesh", constant / "polyMesh/", constant, folder / "",
                               constant / "polyMesh/faces", constant / "polyMesh/owner", folder / "a.foam"}) {
    SCOPED_TRACE(path);
    EXPECT_EQ(read_mesh(path).report.cells, 7u);
    const std::vector<fs::path> files = files_of_mesh(path);
    for (const char* name : {"points", "faces", "owner", "neighbour", "boundary"})
      EXPECT_EQ(std::count_if(
                    files.begin(), files.end(),
                    [&](const fs::path& file) { return fs::equivalent(file, constant / "polyMesh" / name); }),
                1)
          << name;
    EXPECT_EQ(files.size(), path.filename() == "a.foam" ? 6u : 5u);
  }
  for (const char* name : {"points", "faces", "owner", "neighbour", "boundary"}) {
    const fs::path file = constant / "polyMesh" / name;
    gzip_file(file, file.string() + ".gz");
    fs::remove(file);
  }
  EXPECT_EQ(read_mesh(folder / "").report.cells, 7u);
  EXPECT_EQ(read_mesh(constant / "polyMesh/points.gz").report.cells, 7u);
  EXPECT_EQ(read_body<3>(folder / "").body.faces.size(), 2u * 35);

  EXPECT_EQ(files_of_mesh(folder / "").size(), 5u);
  EXPECT_EQ(files_of_mesh(constant / "polyMesh/points.gz").size(), 5u);

  const std::string packed = (constant / "polyMesh/faces.gz").string();
  fs::remove(packed);
  EXPECT_EQ(files_of_mesh(folder / "").size(), 4u);
  EXPECT_EQ(refusal([&] { read_mesh(folder / ""); }),
            with(packed, ".gz", "") + ": is missing, and a mesh of OpenFOAM needs it: copy the whole folder");
  EXPECT_EQ(refusal([&] { read_mesh(constant / "polyMesh/points.gz"); }),
            (constant / "polyMesh/points.gz").string() +
                ": is one file of OpenFOAM: give the folder polyMesh of a mesh, with all its files");
}

TEST(PolyMesh, OtherMeshesAreFilesOfTheirOwn) {
  const Folder folder;
  const fs::path poly = folder / "a.poly", points = folder / "a.node";
  std::ofstream(poly) << "0 2 0 0\n";
  EXPECT_EQ(files_of_mesh(poly), std::vector<fs::path>{poly});
  std::ofstream(points) << "3 2 0 0\n";
  EXPECT_EQ(files_of_mesh(poly), (std::vector<fs::path>{poly, points}));
  EXPECT_EQ(files_of_mesh(folder / "a.off"), std::vector<fs::path>{folder / "a.off"});
  EXPECT_TRUE(files_of_mesh(folder / "").empty());
}

TEST(PolyMesh, FoldersWithoutOneAreRefused) {
  const Folder folder;
  const std::string name = (folder / "").string();
  EXPECT_EQ(
      refusal([&] { read_mesh(name); }),
      name + ": is a directory without a mesh of OpenFOAM: name a file, or a folder with polyMesh in it");
  fs::create_directories(folder / "processor0/constant/polyMesh");
  EXPECT_EQ(
      refusal([&] { read_mesh(name); }),
      name + ": holds the mesh in parts, processor0 and so on: put them together by reconstructParMesh");
  // A file of such a name beside no mesh is what its content says.
  EXPECT_EQ(read_mesh(folder.write("points", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 1\n3 0 1 2\n")).report.format,
            "OFF");
}

TEST(PolyMesh, BafflesAreWallsOnBothSides) {
  Foam_mesh mesh = test::foam_block(3);
  test::make_baffle(mesh, 12, 13);
  const Mesh_file file = parse(mesh);
  EXPECT_EQ(file.report.notes,
            (Notes{"1 pair of boundary faces with the same points, read as walls (baffles)"}));
  const Cell_soup<3>& soup = cells_of(file);
  EXPECT_EQ(shared_facets(soup), 53u) << "the baffle is among them";
  EXPECT_EQ(wall_count(soup), 56u);
  ASSERT_EQ(file.groups.at("front").facets.size(), 1u);
  for (const char* side : {"front", "back"}) EXPECT_TRUE(soup.impassable[file.groups.at(side).facets[0]]);
}

TEST(PolyMesh, PatchesThatLeadElsewhereAreNoted) {
  Foam_mesh mesh = test::foam_block(2);
  mesh.patches[0].type = mesh.patches[1].type = "cyclicAMI";
  mesh.patches[2].type = "processor";
  EXPECT_EQ(
      parse(mesh).report.notes,
      (Notes{"cyclic patches are walls, not passages: inlet, outlet (8 faces)",
             "patches to other processors are walls: sides (16 faces); reconstructParMesh puts the parts "
             "together"}));
  mesh.patches[0].type = mesh.patches[1].type = "patch";
  mesh.patches[2].type = "empty";
  mesh.patches[1].name = "\"the \001outlet\"";
  EXPECT_EQ(parse(mesh).report.notes,
            (Notes{"a case of two dimensions, read as a layer of 3D cells: sides (16 faces)",
                   "group \"the ?outlet\" named \"the ?outlet\""}));
  mesh = test::foam_block(2);
  mesh.patches.pop_back();
  mesh.patches[1].name = "inlet";
  const Mesh_file file = parse(mesh);
  EXPECT_EQ(file.report.notes, (Notes{"16 boundary faces are in no patch",
                                      "group \"inlet\": several patches or zones of this name"}));
  EXPECT_EQ(file.groups.at("inlet").facets.size(), 8u);
}

TEST(PolyMesh, ZonesAreGroups) {
  const Foam_mesh mesh = test::foam_block(3);
  for (const Foam_encoding& encoding : encodings) {
    const Foam_writer writer(encoding);
    Files files = writer.files(mesh);
    files["cellZones"] = writer.zones({{"rotor", {5, 3, 5}}, {"none", {}}});
    files["faceZones"] = writer.zones({{"gate", {0, 52, 53}}, {"rotor", {1}}}, "face");
    const Mesh_file file = parse(files);
    EXPECT_EQ(file.groups.size(), 5u);
    EXPECT_EQ(file.groups.at("rotor").cells, (std::vector<std::uint32_t>{3, 5}));
    EXPECT_EQ(file.groups.at("rotor").facets.size(), 2u);
    EXPECT_EQ(file.groups.at("gate").facets.size(), 5u) << "53 faces lie inside";
    EXPECT_EQ(file.report.notes, (Notes{"group \"rotor\": several patches or zones of this name"}));
  }
}

TEST(PolyMesh, OtherFormsOfListsAreRead) {
  const Foam_mesh mesh = test::foam_block(2);
  const Mesh_file plain = parse(mesh);
  // Of versions that list no neighbour for each face of the boundary.
  Foam_mesh old = mesh;
  old.neighbour.resize(mesh.faces.size(), -1);
  EXPECT_EQ(cells_of(parse(old)).vertices, cells_of(plain).vertices);
  // A list without its length, with comments.
  Files files = Foam_writer().files(mesh);
  const std::string count = "\n" + std::to_string(mesh.neighbour.size()) + "\n(";
  files["neighbour"] = with(files["neighbour"], count, " // none\n /* 3( */(");
  EXPECT_EQ(cells_of(parse(files)).vertices, cells_of(plain).vertices);
  // One cell: all have the same owner, and none a neighbour.
  const Files cube = {
      {"points", Foam_writer().header("vectorField", "points") + "4((0 0 0)(1 0 0)\n(0 1 0)(0 0 1e0))"},
      {"faces", Foam_writer().header("faceList", "faces") + "4(3(0 2 1)3(0 1 3)3(1 2 3)3(2 0 3))"},
      {"owner", Foam_writer().header("labelList", "owner") + "4{0}"},
      {"neighbour", Foam_writer().header("labelList", "neighbour") + "0()"},
      {"boundary", Foam_writer().header("polyBoundaryMesh", "boundary") + "0()"}};
  EXPECT_EQ(six_volumes(cells_of(parse(cube))), (std::vector<double>{1}));
}

TEST(PolyMesh, BrokenFilesAreRefusedWithTheirPlace) {
  const Foam_mesh mesh = test::foam_block(2);  // 7 cells, 35 faces, 11 of them inside
  struct Case {
    std::string file, from, to, message;
  };
  const Case cases[] = {
      {"points", "FoamFile", "OtherFile",
       "points:4: not a file of OpenFOAM: it does not begin with a header 'FoamFile'"},
      {"points", "ascii", "asci", "points:7: the format 'asci' is not known: ascii and binary are"},
      {"points", "27\n(", "28\n(", "points:45: announces 28 points, and holds 27"},
      {"points", "27\n(", "26\n(", "points:45: '(' where ')' of the points should be"},
      {"points", "27\n(", "9999999999\n(", "points:17: announces 9999999999 points, more than the"},
      {"points", "27\n(", "-1\n(", "points:17: announces -1 points: it is broken"},
      {"points", "(1.0", "(1.0e999",
       "points:20: a coordinate: '1.0e99900000' is not a number that a double can hold"},
      {"points", "(1.0", "(nan 0 0) (1.0", "points:20: a coordinate: 'nan' is not finite"},
      {"points", "(1.000000 0.0", "(1 0 0 0.0", "points:20: '0.000000' where ')' of a point should be"},
      {"points", "\n\n27\n(", "\n/* 27\n(", "points:16: a comment without an end: the file is cut short"},
      {"faces", "35\n(", "36\n(", "announces 36 faces, and holds 35"},
      {"faces", " 4 ( 3 12 13 4 )", " 4 ( 3 12 27 4 )",
       "faces:19: points of a face: number 2 is 27, where 0 to 26 are possible"},
      {"faces", " 4 ( 3 12 13 4 )", " 4 ( 3 -4 13 4 )", "number 1 is -4, where 0 to 26 are possible"},
      {"faces", " 4 ( 3 12 13 4 )", " 5 ( 3 12 13 4 )",
       "points of a face: 5 are announced, and the list holds 4"},
      {"faces", " 4 ( 3 12 13 4 )", " 2 ( 3 12 )", "faces:19: face 0 has 2 points: at least 3 are needed"},
      {"faces", " 4 ( 3 12 13 4 )", " 4 ( 3 x 13 4 )", "points of a face: 'x' is not an integer"},
      {"faces", " 4 ( 3 12 13 4 )", " 4{1}", "points of a face: 4 equal ones, where at most 1 are possible"},
      {"owner", "\n35\n(", "\n3500000000000000000\n(",
       "announces 3500000000000000000 owners of faces, more than the"},
      {"owner", "\n35\n(", "\n350000000000000000000\n(",
       "the number of owners of faces: '350000000000000000000' is not an integer"},
      {"owner", "\n35\n(\n", "\n36\n(\n0\n",
       "owner: holds 36 owners of faces, and there are 35 faces: it is cut short, or of another mesh"},
      {"owner", "\n35\n(\n0\n", "\n35\n(\n-1\n",
       "owner:19: owners of faces: number 0 is -1, where 0 to 16 are possible"},
      {"owner", "6\n)", "11\n)",
       "owner: names cell 11, and 35 faces bound at most 11 cells: it is of another mesh"},
      {"owner", "6\n)", "17\n)", "owner:53: owners of faces: number 34 is 17, where 0 to 16 are possible"},
      {"neighbour", "\n11\n(\n", "\n36{3}",
       "neighbours of faces: 36 equal ones, where at most 35 are possible"},
      {"neighbour", "\n11\n(\n1\n", "\n11\n(\n0\n",
       "neighbour: face 0 has owner 0 and neighbour 0: an owner is the lower of two cells; renumberMesh puts "
       "them in order"},
      {"neighbour", "\n11\n(\n1\n", "\n11\n(\n-1\n",
       "neighbour: face 0 has no neighbour, and faces after it have: renumberMesh puts them in order"},
      {"boundary", "nFaces          4", "nFaces          5",
       "the patch 'outlet' has 4 faces from 15 on, where 16 to 35 are left"},
      {"boundary", "nFaces          16", "nFaces          17",
       "the patch 'sides' has 17 faces from 19 on, where 19 to 35 are left"},
      {"boundary", "nFaces          16", "nFaces          -16", "announces -16 faces: it is broken"},
      {"boundary", "startFace       11", "startFace       10",
       "boundary:25: the patch 'inlet' has 4 faces from 10 on, where 11 to 35 are left"},
      {"boundary", "startFace       11", "begin 11", "the patch 'inlet' has no startFace or no nFaces"},
      {"boundary", "\n3\n(", "\n4\n(", "announces 4 patches, and holds 3"},
      {"boundary", "\n3\n(", "\n2\n(", "'sides' where ')' of patches should be"},
      {"boundary", "startFace       11;", "startFace       11", "'}' where an entry should end"},
      {"boundary", "    inlet\n    {", "    inlet\n    (", "'(' where '{' of 'inlet' should be"},
      {"boundary", "    inlet\n", "    \"inlet\n", "a text in quotes without an end"}};
  const Files sound = Foam_writer().files(mesh);
  parse(sound);
  for (const Case& c : cases) {
    SCOPED_TRACE(c.message);
    Files files = sound;
    files[c.file] = with(files[c.file], c.from, c.to);
    const std::string why = refusal([&] { parse(files); });
    EXPECT_TRUE(why.starts_with(c.file + ":")) << why;
    EXPECT_NE(why.find(c.message), std::string::npos) << why;
  }
}

TEST(PolyMesh, BrokenBinaryFilesAreRefusedWithTheirByte) {
  const Foam_mesh mesh = test::foam_block(2);
  const Files sound = Foam_writer({true, 32, 64}).files(mesh);
  struct Case {
    std::string file, from, to, message;
  };
  const Case cases[] = {
      {"points", "27\n(", "28\n(", "')' of points should be"},
      {"points", "27\n(", "27000000\n(", "announces 27000000 points, more than the"},
      {"points", "scalar=64", "scalar=80", "only numbers of 32 and 64 bits are read"},
      {"points", "27\n(" + std::string(8, '\0'), "27\n(" + std::string(7, '\xff') + '\x7f',
       "point 0 has a coordinate that is not finite"},
      {"faces", std::string("\0\0\0\0\4\0\0\0", 8), std::string("\0\0\0\0\2\0\0\0", 8),
       "face 0 has 2 points: at least 3 are needed"},
      {"faces", std::string("\0\0\0\0\4\0\0\0", 8), std::string("\0\0\0\0\xff\0\0\0", 8),
       "its faces do not take the 140 points that are listed"},
      {"faces", std::string("\3\0\0\0\14\0\0\0\15", 9), std::string("\3\0\0\0\14\0\0\1\15", 9),
       "points of a face: number 1 is 16777228, where 0 to 26 are possible"},
      {"owner", "35\n(", "3\n(", "where ')' of owners of faces should be"},
      {"owner", "LSB", "MSB", "is 16777216, where 0 to"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.message);
    Files files = sound;
    files[c.file] = with(files[c.file], c.from, c.to);
    const std::string why = refusal([&] { parse(files); });
    EXPECT_TRUE(why.starts_with(c.file + ": byte ") || c.message.starts_with("only")) << why;
    EXPECT_NE(why.find(c.message), std::string::npos) << why;
  }
}

/// Whatever is done to a file, the mesh is read, with all its promises, or refused.
TEST(PolyMesh, DamagedFilesAreReadOrRefused) {
  std::mt19937 random(42);
  std::size_t read = 0, refused = 0;
  std::set<std::string> reasons;
  for (const Foam_encoding& encoding : {Foam_encoding{}, Foam_encoding{true, 32, 64}}) {
    const Foam_writer writer(encoding);
    Files sound = writer.files(test::foam_block(2));
    sound["cellZones"] = writer.zones({{"rotor", {5, 3}}});
    sound["faceZones"] = writer.zones({{"gate", {0, 11}}}, "face");
    for (int i = 0; i < 4000; ++i) {
      Files files = sound;
      auto file = std::next(files.begin(), i % 7);
      file->second =
          i % 3 == 0 ? file->second.substr(0, random() % file->second.size()) : damaged(file->second, random);
      try {
        const Mesh_file found = parse(files);
        ++read;
        const Cell_soup<3>& soup = cells_of(found);
        for (const std::uint32_t v : soup.vertices) ASSERT_LT(v, soup.points.size());
        for (const auto& [name, group] : found.groups) {
          for (const std::uint32_t f : group.facets) ASSERT_LT(f, soup.facet_count());
          for (const std::uint32_t c : group.cells) ASSERT_LT(c, soup.cell_count());
        }
      } catch (const Error& error) {
        ASSERT_EQ(error.code(), Error_code::input) << error.what();
        const std::string why = error.what();
        ASSERT_TRUE(files.contains(why.substr(0, why.find(':')))) << why;
        ++refused;
        reasons.insert(why);
      }
    }
  }
  EXPECT_GT(read, 1000u);
  EXPECT_GT(refused, 3000u);
  EXPECT_GT(reasons.size(), 500u);
}

}  // namespace
}  // namespace cellwalk::io
