// SPDX-License-Identifier: LGPL-3.0-or-later
// Parts that use large libraries are modules of their own, which a program loads when it first needs them.
#ifndef CELLWALK_INTERNAL_IO_MODULE_H
#define CELLWALK_INTERNAL_IO_MODULE_H

#include <string>

namespace cellwalk::io {

/// A function of a module, or the reason why there is none.
struct Module_function {
  void* function = nullptr;
  std::string problem;
};

/// Loads a module, which stays loaded, and finds a function of it. The module is searched for in the folder
/// CELLWALK_READERS; beside the program or Python module in its build or prefix; in the search paths of the
/// linker and the system; and in the folder of the installation. One of another version of Cellwalk is passed
/// over.
/// \param file name of the module, without a folder
/// \param name of the function
/// \param version returns the version of Cellwalk that a module belongs to, of that function
Module_function load_module(const std::string& file, const char* name, const char* (*version)(void*));

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_MODULE_H
