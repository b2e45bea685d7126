// SPDX-License-Identifier: LGPL-3.0-or-later
// The modules by their file names, each loaded once.
#include "reader_module.h"

#include <cellwalk/internal/io/module.h>

namespace cellwalk::io {
namespace {

const Reader_module* description(void* entry) { return reinterpret_cast<Reader_module_entry>(entry)(); }

Loaded_module load_reader(const std::string& file) {
  const Module_function entry =
      load_module(file, reader_module_entry, [](void* found) { return description(found)->cellwalk; });
  return {entry.function != nullptr ? description(entry.function) : nullptr, entry.problem};
}

}  // namespace

const Loaded_module& vtk_module() {
  static const Loaded_module module = load_reader("libcellwalk_vtk.so");
  return module;
}

}  // namespace cellwalk::io
