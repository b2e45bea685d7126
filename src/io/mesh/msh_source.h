// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: the sections of a .msh file, and the numbers in them, as text or binary.
#ifndef CELLWALK_IO_MESH_MSH_SOURCE_H
#define CELLWALK_IO_MESH_MSH_SOURCE_H

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "word_reader.h"

namespace cellwalk::io {

struct Msh_header {
  std::string version;  ///< such as "1" or "4.1"
  bool binary = false;
  std::int64_t size_of_sizes = 8;  ///< bytes of the larger integers in a binary file
};

/// \throw Error(input) with file and line if this is not a .msh file
Msh_header read_msh_header(const std::string& name, std::string_view bytes);

/// The numbers of a section, one after the other. `what` names them in errors.
class Msh_source {
 public:
  virtual ~Msh_source() = default;
  /// The name of the next section; empty at the end of the file.
  virtual std::string next_section() = 0;
  /// Goes to the end of the section.
  /// \throw Error(input) if anything is left before it
  virtual void end_section(const std::string& section) = 0;
  /// Goes to the end of the section, of which only that is known.
  virtual void skip_section(const std::string& section) = 0;

  virtual std::int64_t integer(std::string_view what) = 0;  ///< of 32 bits in a binary file
  virtual std::int64_t size(std::string_view what) = 0;     ///< of 64 bits there
  virtual double real(std::string_view what) = 0;
  /// A number of a line of text, also in a binary file.
  virtual std::int64_t number_on_line(std::string_view what) = 0;
  /// A text in quotes, which is the rest of a line, also in a binary file.
  virtual std::string quoted(std::string_view what) = 0;
  [[noreturn]] virtual void fail(const std::string& what) const = 0;
};

std::unique_ptr<Msh_source> msh_text(const std::string& name, std::string_view bytes);
std::unique_ptr<Msh_source> msh_binary(const std::string& name, std::string_view bytes);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_MSH_SOURCE_H
