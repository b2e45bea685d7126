// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/loading/environment_file.h>

#include <fmt/core.h>

namespace cellwalk {
namespace {

/// \param soup of the file
template <int D>
Loaded_environment build_as_it_stands(Cell_soup<D>& soup, const Build_options& options, io::Mesh_file& file) {
  const Group_places<D> places(soup, file.groups);
  Build_report report;
  auto environment = Environment<D>::build(std::move(soup), options, &report);
  if (report.flipped)
    throw Error(Error_code::not_certified,
                "every cell is inverted; `cellwalk import` turns them round and writes an environment");
  Groups<D> groups = places.find(environment.snapshot(), report.origin);
  return {std::move(environment), std::move(report), std::move(file.report), std::move(groups)};
}

}  // namespace

Loaded_environment load_environment(const std::string& path, Build_options options) {
  io::Mesh_file file = io::read_mesh(path);
  options.split = false;
  return naming(path, [&]() -> Loaded_environment {
    if (auto* soup = std::get_if<Cell_soup<3>>(&file.mesh)) return build_as_it_stands(*soup, options, file);
    if (auto* soup = std::get_if<Cell_soup<2>>(&file.mesh)) return build_as_it_stands(*soup, options, file);
    throw Error(Error_code::input,
                fmt::format("holds a {}, no cells; make an environment of it with `cellwalk import`",
                            io::kind_name(file.mesh)));
  });
}

}  // namespace cellwalk
