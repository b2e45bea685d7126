// SPDX-License-Identifier: LGPL-3.0-or-later
// Compiled environments of which entries were changed, with checksums that fit: what is opened is used, as
// commands use it, without a test before.
#include <cellwalk/environment/compiled.h>

#include <optional>
#include <variant>

#include "fuzz/forge.h"
#include "fuzz/targets.h"
#include "fuzz/use_opened.h"

namespace cellwalk::fuzz {

void forged(std::string_view bytes) {
  Decoder in(bytes);
  const Image image = forged_image(in);
  std::optional<Any_compiled_environment> opened;
  const bool is_open = reads([&] { opened.emplace(open_compiled_copy(image)); });
  ++(is_open ? counted_uses().opened : counted_uses().refused);
  if (is_open) std::visit([&](auto& known) { use(known.environment, in); }, *opened);
}

}  // namespace cellwalk::fuzz
