// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/io/body_file.h>

#include <gtest/gtest.h>
#include <zlib.h>

#include <functional>

#include "io/io_fixture.h"
#include "records/body_checks.h"

namespace cellwalk::io {
namespace {

using Edges = std::vector<std::array<std::uint32_t, 2>>;
using Faces = std::vector<std::array<std::uint32_t, 3>>;
using Notes = std::vector<std::string>;
using Radii = std::vector<double>;

const std::string tetrahedron =
    "OVM ASCII\nVertices\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\nEdges\n6\n0 1\n0 2\n0 3\n1 2\n1 3\n2 3\n"
    "Faces\n4\n3 2 7 1\n3 0 8 5\n3 6 10 9\n3 3 4 11\nPolyhedra\n1\n4 0 2 4 6\n";

/// Reads `text` as a file of that name; what is read must be a body.
template <int D>
Body_file<D> read(const std::string& name, const std::string& text) {
  const Folder folder;
  Body_file<D> file = read_body<D>(folder.write(name, text));
  EXPECT_EQ(test::flaw(file.body), "");
  EXPECT_EQ(file.report.points, file.body.points.size());
  EXPECT_EQ(file.report.facets, file.body.faces.size());
  return file;
}

/// What is said of `text` after the name of the folder.
template <int D>
std::string said_of(const std::string& name, const std::string& text) {
  const Folder folder;
  const auto path = folder.write(name, text);
  const std::string message = refusal([&] { read_body<D>(path); });
  EXPECT_TRUE(message.starts_with(path.string())) << message;
  return message.substr(path.parent_path().string().size() + 1);
}

// A triangle, a segment that hangs on it, and a vertex of its own at the place of another.
const Edges flag_edges{{0, 1}, {0, 2}, {1, 2}, {2, 3}};
const Faces flag_faces{{0, 1, 2}};
const std::string flag_off = "OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 3 0\n1 0 0\n3 0 1 2\n2 3 2\n1 4\n";
const std::string flag_obj =
    "o flag\nv 0 0 0\nv 1 0 0\nv 0 1 0\nl 3 4\nv 0 3 0\nv 1 0 0\nf 1/1 2/2 -3\np 5\nl 1 2 \\\n3\n";
const std::string flag_ply =
    "ply\nformat ascii 1.0\nelement vertex 5\nproperty double x\nproperty double y\nproperty double z\n"
    "element face 1\nproperty list uchar int vertex_indices\nelement edge 1\nproperty int vertex1\n"
    "property uchar red\nproperty int vertex2\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n0 3 0\n1 0 0\n3 0 1 2\n3 255 2\n";

TEST(BodyFile, ReadsEdgesAndFacesInSpace) {
  struct Case {
    const char* name;
    std::string text, format;
    Notes notes;
  };
  const Case cases[] = {
      {"b.off", flag_off, "OFF", {"1 facets of fewer than 2 vertices ignored", "1 vertices on no edge"}},
      {"b.obj", flag_obj, "OBJ", {"statements ignored: o, p", "1 vertices on no edge"}},
      {"b.ply", flag_ply, "PLY", {"1 vertices on no edge"}}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    const auto file = read<3>(c.name, c.text);
    EXPECT_EQ(file.body.points,
              (std::vector<Point<3>>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 3, 0}, {1, 0, 0}}));
    EXPECT_EQ(file.body.edges, flag_edges);
    EXPECT_EQ(file.body.faces, flag_faces);
    EXPECT_EQ(file.report.format, c.format);
    EXPECT_EQ(file.report.notes, c.notes);
  }
}

TEST(BodyFile, ReadsFlatFilesInThePlane) {
  for (const auto& [name, text] : {std::pair{"b.off", flag_off}, {"b.obj", flag_obj}, {"b.ply", flag_ply}}) {
    SCOPED_TRACE(name);
    const auto file = read<2>(name, with(text, "0 3 0", "0 3 -0"));
    EXPECT_EQ(file.body.points, (std::vector<Point<2>>{{0, 0}, {1, 0}, {0, 1}, {0, 3}, {1, 0}}));
    EXPECT_EQ(file.body.edges, flag_edges);
    EXPECT_TRUE(file.body.faces.empty());
  }
}

TEST(BodyFile, RefusesAHeightInThePlaneWithItsLine) {
  const std::string what = ": z is 0.5, in a 2D body: make every z zero, or use it in 3D";
  EXPECT_EQ(said_of<2>("b.off", with(flag_off, "0 3 0", "0 3 0.5")), "b.off:6" + what);
  EXPECT_EQ(said_of<2>("b.obj", with(flag_obj, "0 3 0", "0 3 0.5")), "b.obj:6" + what);
  EXPECT_EQ(said_of<2>("b.ply", with(flag_ply, "0 3 0", "0 3 0.5")), "b.ply:17" + what);
  EXPECT_EQ(said_of<2>("b.stl", "solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0.5\nendfacet\n"),
            "b.stl:5" + what);
  EXPECT_EQ(said_of<2>("b.ovm", with(tetrahedron, "0 0 1", "0 0 0.5")), "b.ovm: vertex 3" + what);
}

TEST(BodyFile, CutsPolygonsAndReportsIt) {
  const std::string quad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 3 4 1 2\nf 2 1 4 3\nf 1 1 2\n";
  const auto file = read<3>("q.obj", quad);
  EXPECT_EQ(file.body.faces, (Faces{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(file.body.edges, (Edges{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {2, 3}}));
  EXPECT_EQ(file.report.notes, (Notes{"2 polygons cut into triangles: the diagonals are edges",
                                      "2 triangles with the corners of an earlier one left out",
                                      "1 triangles in which a corner occurs twice left out",
                                      "1 edges from a vertex to itself left out"}));
  EXPECT_EQ(read<2>("q.obj", quad).body.edges, (Edges{{0, 1}, {0, 3}, {1, 2}, {2, 3}}));
}

TEST(BodyFile, ReadsOpenNonManifoldAndScatteredBodies) {
  // Three triangles on one edge, two that share a vertex only, and a segment apart.
  const auto file =
      read<3>("n.obj",
              "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nv 5 0 0\nv 5 1 0\nv 9 9 9\nv 9 9 8\n"
              "f 1 2 3\nf 1 2 4\nf 1 2 5\nf 1 6 7\nl 8 9\n");
  EXPECT_EQ(file.body.faces.size(), 4u);
  EXPECT_EQ(file.body.edges.size(), 11u);
  EXPECT_TRUE(file.report.notes.empty());
  EXPECT_EQ(read<3>("p.obj", "v 1 2 3\n").body.points, (std::vector<Point<3>>{{1, 2, 3}}));
}

TEST(BodyFile, ReadsStlMergingItsCorners) {
  const auto file = read<3>("s.stl",
                            "solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendfacet\n"
                            "facet\nvertex 1 0 0\nvertex 0 0 0\nvertex 0 0 1\nendfacet\nendsolid\n");
  EXPECT_EQ(file.body.points.size(), 4u);
  EXPECT_EQ(file.body.edges, (Edges{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}}));
  EXPECT_EQ(file.body.faces, (Faces{{0, 1, 2}, {0, 3, 1}}));
}

TEST(BodyFile, ReadsBinaryOffWithEdges) {
  std::string bytes = "OFF BINARY\n";
  const auto append = [&](auto value) {
    const auto* p = reinterpret_cast<const char*>(&value);
    for (std::size_t i = sizeof value; i-- > 0;) bytes.push_back(p[i]);  // big endian
  };
  for (std::uint32_t n : {3, 2, 0}) append(n);
  for (float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) append(x);
  for (std::uint32_t n : {2, 2, 0, 0, 2, 1, 0, 0}) append(n);
  EXPECT_EQ(read<3>("b.off", bytes).body.edges, (Edges{{0, 1}, {0, 2}}));
  EXPECT_EQ(read<2>("b.off", bytes).body.edges, (Edges{{0, 1}, {0, 2}}));
}

TEST(BodyFile, ReadsPolylinesFromTables) {
  const auto file = read<3>("c.csv", "# a catheter\nz,x,name,y\n1/4,1e-3,a,0\n0,0x1p-1,b,2\n0,0,c,3\n");
  EXPECT_EQ(file.body.points, (std::vector<Point<3>>{{1e-3, 0, 0.25}, {0.5, 2, 0}, {0, 3, 0}}));
  EXPECT_EQ(file.body.edges, (Edges{{0, 1}, {1, 2}}));
  EXPECT_EQ(file.report.format, "CSV");
  EXPECT_EQ(read<2>("c.csv", "x,y\n1,2\n").body.points, (std::vector<Point<2>>{{1, 2}}));
}

// A flag whose pole is thick.
const std::string thick_ply = with(with(flag_ply, "element edge 1", "element edge 3"),
                                   "property uchar red\nproperty int vertex2\nend_header",
                                   "property float radius\nproperty int vertex2\nend_header") +
                              "1 0.125 2\n2 0.5 3\n";

TEST(BodyFile, ReadsRadiiOfEdges) {
  const auto flag = read<3>("b.ply", with(thick_ply, "3 255 2", "3 0.25 2"));
  EXPECT_EQ(flag.body.edges, flag_edges);
  EXPECT_EQ(flag.body.radii, (Radii{0, 0, 0.125, 0.5})) << "sides of faces have none; the larger of two";
  EXPECT_EQ(read<2>("b.ply", with(thick_ply, "3 255 2", "3 1e-3 2")).body.radii, (Radii{0, 0, 0.125, 0.5}));
  EXPECT_EQ(read<3>("b.ply", with(thick_ply, "property float radius", "property float width")).body.radii,
            Radii{});
  EXPECT_EQ(read<3>("b.ply", flag_ply).body.radii, Radii{});

  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty uchar x\nproperty uchar y\n"
      "property uchar z\nelement edge 1\nproperty uchar vertex1\nproperty uchar vertex2\n"
      "property double radius\nend_header\n";
  bytes += std::string("\0\0\0\1\1\1\0\1\0\0\0\0\0\0\xc0\x3f", 16);
  EXPECT_EQ(read<3>("b.ply", bytes).body.radii, Radii{0.125});
}

TEST(BodyFile, ReadsRadiiOfPolylines) {
  const auto file = read<3>("c.csv", "x,radius,y,z\n0,1/4,0,0\n1,0x1p-3,0,0\n2,0,0,0\n3,,0,0\n");
  EXPECT_EQ(file.body.edges, (Edges{{0, 1}, {1, 2}, {2, 3}}));
  EXPECT_EQ(file.body.radii, (Radii{0.25, 0.125, 0}));
  EXPECT_EQ(read<2>("c.csv", "x,y,radius\n0,0,2\n1,0,9\n").body.radii, Radii{2}) << "not of the last row";
  EXPECT_EQ(read<2>("c.csv", "x,y,radius\n0,0,0\n1,0,-0\n2,0,9\n").body.radii, Radii{});
  // A vertex that is the whole body.
  EXPECT_EQ(read<2>("c.csv", "x,y,radius\n0,0,2\n").body.radii, Radii{2});
  EXPECT_EQ(read<2>("c.csv", "x,y,radius\n0,0,\n").body.radii, Radii{});
}

TEST(BodyFile, ReadsCellsAndDomains) {
  const auto tetrahedra = read<3>("t.ovm", tetrahedron);
  EXPECT_EQ(tetrahedra.body.edges.size(), 6u);
  EXPECT_EQ(tetrahedra.body.faces.size(), 4u);
  const std::string square = "POLYGON((0 0, 2 0, 2 2, 0 2, 0 0))\n";
  EXPECT_EQ(read<2>("d.wkt", square).body.edges, (Edges{{0, 1}, {0, 3}, {1, 2}, {2, 3}}));
  EXPECT_EQ(read<3>("d.wkt", square).body.points.back(), (Point<3>{0, 2, 0}));
  const auto cells =
      read<2>("d.ovm",
              "OVM ASCII\nVertices\n3\n0 0 0\n1 0 0\n0 1 0\nEdges\n3\n0 1\n1 2\n2 0\nFaces\n1\n3 0 2 4\n"
              "Polyhedra\n0\n");
  EXPECT_EQ(cells.body.edges, (Edges{{0, 1}, {0, 2}, {1, 2}}));
}

TEST(BodyFile, GoesByTheContentAndReadsCompressedFiles) {
  EXPECT_EQ(read<3>("b.obj", flag_off).report.notes.back(),
            "the extension says OBJ, the content OFF: read by its content");
  const Folder folder;
  gzFile out = gzopen((folder / "c.csv.gz").c_str(), "wb");
  gzputs(out, "x,y\n0,0\n1,0\n");
  gzclose(out);
  EXPECT_EQ(read_body<2>(folder / "c.csv.gz").body.edges, (Edges{{0, 1}}));
}

TEST(BodyFile, RefusesWithFileAndLine) {
  struct Case {
    const char* name;
    std::string text, message;
  };
  const Case cases[] = {
      {"b.off", with(flag_off, "2 3 2", "2 3 5"),
       "b.off:9: vertex 5 is out of range: there are 5, counted from 0"},
      {"b.off", with(flag_off, "0 3 0", "0 1e999 0"),
       "b.off:6: a coordinate: '1e999' is not a number that a double can hold"},
      {"b.off", with(flag_off, "0 3 0", "0 nan 0"), "b.off:6: a coordinate: 'nan' is not finite"},
      {"b.obj", with(flag_obj, "l 3 4", "l 3"), "b.obj:5: a line of 1 vertices: at least 2 are needed"},
      {"b.obj", with(flag_obj, "l 3 4", "l 3 9"), "b.obj:5: a line names vertex 9, of 5"},
      {"b.obj", with(flag_obj, "l 3 4", "l 3 0"),
       "b.obj:5: '0' is not a corner of a line: an index counted from 1, or a negative one"},
      {"b.obj", with(flag_obj, "l 3 4", "l 3 -4"),
       "b.obj:5: corner '-4' of a line names a vertex that does not exist"},
      {"b.ply", with(flag_ply, "3 255 2", "3 255 5"), "b.ply:20: edge 0 names vertex 5, of 5"},
      {"b.ply", with(flag_ply, "3 255 2", "3 255 -1"), "b.ply:20: edge 0 names vertex -1"},
      {"b.ply", with(flag_ply, "3 255 2\n", ""),
       "b.ply:20: the file ends where an edge should be: it is cut short"},
      {"b.ply", with(flag_ply, "int vertex2", "int vertex3"),
       "b.ply:19: the header gives edges no properties 'vertex1' and 'vertex2'"},
      {"b.csv", "x,y\n0,0\n", "b.csv: has no column 'z': its header names x,y"},
      {"b.csv", "x,y,z\n0,0,0\n\n0,one,0\n", "b.csv:4: y: 'one' is not a number that a double can hold"},
      {"b.csv", "x,y,z\n0,0\n", "b.csv:2: 2 fields, where the header has 3"},
      {"b.csv", "x,y,z\n0,inf,0\n", "b.csv:2: y: 'inf' is not finite"},
      {"b.ply", with(thick_ply, "2 0.5 3", "2 -0.5 3"),
       "b.ply:22: edge 2: radius: takes a finite number of at least 0, not -0.5"},
      {"b.ply", with(thick_ply, "2 0.5 3", "2 nan 3"),
       "b.ply:22: edge 2: radius: takes a finite number of at least 0, not nan"},
      {"b.ply", with(thick_ply, "2 0.5 3", "2 inf 3"),
       "b.ply:22: edge 2: radius: takes a finite number of at least 0, not inf"},
      {"b.ply", with(thick_ply, "2 0.5 3", "2 wide 3"), "b.ply:22: an edge: 'wide' is not a number"},
      {"b.csv", "x,y,z,radius\n0,0,0,-1\n1,0,0,\n",
       "b.csv:2: radius: takes a finite number of at least 0, not -1"},
      {"b.csv", "x,y,z,radius\n0,0,0,1\n\n1,0,0,inf\n", "b.csv:4: radius: 'inf' is not finite"},
      {"b.csv", "x,y,z,radius\n0,0,0,\n1,0,0,\n",
       "b.csv:2: radius: an empty field where a number is expected"},
      {"b.csv", "x,y,z,radius\n0,0,0,1\n1,0,0,wide\n",
       "b.csv:3: radius: 'wide' is not a number that a double can hold"},
      {"b.csv", "x,y,z\n", "b.csv: holds no vertices: a body needs at least one"},
      {"b.csv", " \n", "b.csv: is empty"},
      {"b.obj", "# nothing\n", "b.obj: holds no vertices: a body needs at least one"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.message);
    EXPECT_EQ(said_of<3>(c.name, c.text), c.message);
  }
  EXPECT_EQ(said_of<2>("b.csv", "x,y,z\n0,0,0\n"),
            "b.csv: has a column 'z', and the environment is 2D: leave z out");
  EXPECT_TRUE(said_of<3>("b.xyz", "0 0 0\n")
                  .starts_with("b.xyz: the format is not known, neither by its content nor by its extension; "
                               "bodies are read from .csv, "));
}

/// Cut at every twentieth a file is read or refused; OBJ and CSV may end almost anywhere.
TEST(BodyFile, CutShortNeverCrashes) {
  const Folder folder;
  const auto refused = [&](const std::string& name, const std::string& text) {
    return refused_truncations(text,
                               [&](const std::string& part) { read_body<3>(folder.write(name, part)); });
  };
  EXPECT_GE(refused("b.off", flag_off), 19);
  EXPECT_GE(refused("b.ply", thick_ply), 19);
  EXPECT_GE(refused("b.obj", flag_obj), 3);
}

/// Surfaces are read as before: lines are none of their business.
TEST(BodyFile, LeavesSurfacesAlone) {
  const Folder folder;
  const Mesh_file file = read_mesh(folder.write("s.obj", with(flag_obj, "1 0 0", "1 0 1")));
  EXPECT_EQ(std::get<Surface_soup>(file.mesh).facets.size(), 1u);
  EXPECT_EQ(file.report.notes, (Notes{"statements ignored: l, o, p"}));
  EXPECT_EQ(read_mesh(folder.write("s.ply", with(flag_ply, "1 0 0", "1 0 1"))).report.notes,
            (Notes{"1 elements 'edge' ignored"}));
  EXPECT_EQ(read_mesh(folder.write("s.off", with(flag_off, "1 0 0", "1 0 1"))).report.notes,
            (Notes{"2 facets of fewer than 3 vertices ignored"}));
}

}  // namespace
}  // namespace cellwalk::io
