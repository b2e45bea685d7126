// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/loading/environment_file.h>

#include <fmt/core.h>

namespace cellwalk {
namespace {

template <int D>
Environment<D> build_as_it_stands(Cell_soup<D> soup, const Build_options& options, Build_report& report) {
  auto environment = Environment<D>::build(std::move(soup), options, &report);
  if (report.flipped)
    throw Error(Error_code::not_certified,
                "every cell is inverted; `cellwalk import` turns them round and writes an environment");
  return environment;
}

}  // namespace

Loaded_environment load_environment(const std::string& path, Build_options options) {
  io::Mesh_file file = io::read_mesh(path);
  options.split = false;
  Build_report report;
  return naming(path, [&]() -> Loaded_environment {
    if (auto* soup = std::get_if<Cell_soup<3>>(&file.mesh))
      return {build_as_it_stands(std::move(*soup), options, report), report, std::move(file.report)};
    if (auto* soup = std::get_if<Cell_soup<2>>(&file.mesh))
      return {build_as_it_stands(std::move(*soup), options, report), report, std::move(file.report)};
    throw Error(Error_code::input,
                fmt::format("holds a {}, no cells; make an environment of it with `cellwalk import`",
                            io::kind_name(file.mesh)));
  });
}

}  // namespace cellwalk
