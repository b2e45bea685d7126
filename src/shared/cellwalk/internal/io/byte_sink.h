// SPDX-License-Identifier: LGPL-3.0-or-later
// A file that is written from its beginning to its end.
#ifndef CELLWALK_INTERNAL_IO_BYTE_SINK_H
#define CELLWALK_INTERNAL_IO_BYTE_SINK_H

#include <string_view>

namespace cellwalk::io {

class Byte_sink {
 public:
  Byte_sink() = default;
  virtual ~Byte_sink() = default;
  Byte_sink(const Byte_sink&) = delete;
  Byte_sink& operator=(const Byte_sink&) = delete;

  /// Appends.
  /// \throw Error(other) if the device is full
  virtual void write(std::string_view bytes) = 0;
  /// Completes it.
  /// \throw Error(other) if that fails
  virtual void commit() = 0;
};

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_BYTE_SINK_H
