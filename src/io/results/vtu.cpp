// SPDX-License-Identifier: LGPL-3.0-or-later
// The XML of a grid, with its arrays as text or as compressed base64.
#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/internal/io/gzip.h>
#include <cellwalk/internal/io/vtu.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <iterator>
#include <type_traits>

namespace cellwalk::io {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

template <class T>
constexpr std::string_view type_name() {
  if constexpr (std::is_same_v<T, double>) return "Float64";
  if constexpr (std::is_same_v<T, std::int64_t>) return "Int64";
  if constexpr (std::is_same_v<T, std::uint8_t>) return "UInt8";
}

std::string escaped(std::string_view text) {
  std::string out;
  for (char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out.push_back(c);
    }
  }
  return out;
}

class Text {
 public:
  explicit Text(Vtu_encoding encoding) : encoding_(encoding) {}

  template <class... Arguments>
  void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
    text_.push_back('\n');
  }

  template <class T>
  void array(std::string_view name, int components, std::span<const T> values) {
    line(R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="{}">)", type_name<T>(),
         escaped(name), components, encoding_ == Vtu_encoding::text ? "ascii" : "binary");
    if (encoding_ == Vtu_encoding::text) {
      const auto width = static_cast<std::size_t>(components);
      for (std::size_t i = 0; i < values.size(); i += width)
        line("{}", fmt::join(values.subspan(i, std::min(width, values.size() - i)), " "));
    } else {
      // The bytes are preceded by their number, which is encoded by itself.
      const std::uint64_t size = values.size_bytes();
      append_base64(text_, {reinterpret_cast<const unsigned char*>(&size), sizeof size});
      append_base64(text_, {reinterpret_cast<const unsigned char*>(values.data()), size});
      text_.push_back('\n');
    }
    line("</DataArray>");
  }

  template <class T>
  void array(std::string_view name, int components, const std::vector<T>& values) {
    array(name, components, std::span<const T>(values));
  }

  void data(std::string_view section, const std::vector<Vtu_array>& arrays, std::size_t count) {
    if (arrays.empty()) return;
    line("<{}>", section);
    for (const Vtu_array& a : arrays)
      std::visit(
          [&](const auto& values) {
            if (a.components < 1 || values.size() != count * static_cast<std::size_t>(a.components))
              throw Error(Error_code::usage,
                          fmt::format("the array '{}' has {} values, for {} times {} components", a.name,
                                      values.size(), count, a.components));
            array(a.name, a.components, values);
          },
          a.values);
    line("</{}>", section);
  }

  std::string take() { return std::move(text_); }

 private:
  Vtu_encoding encoding_;
  std::string text_;
};

}  // namespace

void Vtu_grid::add_cell(Vtu_cell type, std::span<const std::uint32_t> vertices) {
  connectivity.insert(connectivity.end(), vertices.begin(), vertices.end());
  offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  types.push_back(static_cast<std::uint8_t>(type));
  if (!face_offsets.empty()) face_offsets.push_back(-1);
}

void Vtu_grid::add_polyhedron(std::span<const std::vector<std::uint32_t>> loops) {
  if (face_offsets.empty()) face_offsets.assign(types.size(), -1);
  std::vector<std::uint32_t> vertices;
  faces.push_back(static_cast<std::int64_t>(loops.size()));
  for (const auto& loop : loops) {
    faces.push_back(static_cast<std::int64_t>(loop.size()));
    for (std::uint32_t v : loop) {
      faces.push_back(v);
      if (std::find(vertices.begin(), vertices.end(), v) == vertices.end()) vertices.push_back(v);
    }
  }
  connectivity.insert(connectivity.end(), vertices.begin(), vertices.end());
  offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  types.push_back(static_cast<std::uint8_t>(Vtu_cell::polyhedron));
  face_offsets.push_back(static_cast<std::int64_t>(faces.size()));
}

std::string vtu_text(const Vtu_grid& grid, Vtu_encoding encoding) {
  Text out(encoding);
  out.line(R"(<?xml version="1.0"?>)");
  out.line(
      R"(<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">)");
  out.line("<UnstructuredGrid>");
  out.line(R"(<Piece NumberOfPoints="{}" NumberOfCells="{}">)", grid.points.size(), grid.cell_count());
  out.line("<Points>");
  out.array("Points", 3,
            std::span(grid.points.empty() ? nullptr : grid.points[0].data(), 3 * grid.points.size()));
  out.line("</Points>");
  out.line("<Cells>");
  out.array("connectivity", 1, grid.connectivity);
  out.array("offsets", 1, grid.offsets);
  out.array("types", 1, grid.types);
  if (!grid.face_offsets.empty()) {
    out.array("faces", 1, grid.faces);
    out.array("faceoffsets", 1, grid.face_offsets);
  }
  out.line("</Cells>");
  out.data("PointData", grid.point_data, grid.points.size());
  out.data("CellData", grid.cell_data, grid.cell_count());
  out.line("</Piece>\n</UnstructuredGrid>\n</VTKFile>");
  return out.take();
}

void write_vtu(const std::filesystem::path& path, const Vtu_grid& grid, Vtu_encoding encoding) {
  write_file(path, vtu_text(grid, encoding));
}

}  // namespace cellwalk::io
