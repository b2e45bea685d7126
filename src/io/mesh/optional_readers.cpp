// SPDX-License-Identifier: LGPL-3.0-or-later
// The call of the module of VTK, or the error that the build or the machine has none.
#include "optional_readers.h"

#include <fmt/format.h>

#include <mutex>
#include <new>
#include <stdexcept>

#include "io/files/text.h"
#include "vtk_text.h"

namespace cellwalk::io {
namespace {

/// Reads one file at a time, since the states of the libraries are global.
Element_soup read_by(const Loaded_module& loaded, const char* library, const std::string& name,
                     const Reader_input& input, Read_report& report) {
  if (loaded.module == nullptr)
    fail(name,
         fmt::format(
             "{}, which reads it, cannot be loaded ({}): install cellwalk-readers, or name the folder of "
             "the readers in CELLWALK_READERS",
             library, loaded.problem));
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  try {
    return loaded.module->read(name, input, report);
  } catch (const std::bad_alloc&) {
  } catch (const std::length_error&) {
  }
  fail(name, fmt::format("broken, or too large for the memory of this machine: {} runs out of it", library));
}

}  // namespace

bool has_vtk() { return CELLWALK_HAS_VTK; }

Mesh_file parse_by_vtk(const std::string& name, std::string_view bytes, Format format) {
  if (!has_vtk())
    fail(name,
         "this build lacks VTK, which reads .vtk and .vtu: install libvtk9-dev and configure with "
         "-DCELLWALK_WITH_VTK=ON, or convert the file to .ovm");
  if (format == Format::vtk_xml) check_vtk_counts(name, bytes);
  Read_report report;
  Element_soup soup = read_by(vtk_module(), "VTK", name, {bytes, format}, report);
  return volumes_or_polygons(name, std::move(soup), std::move(report));
}

}  // namespace cellwalk::io
