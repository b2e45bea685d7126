// SPDX-License-Identifier: LGPL-3.0-or-later
// Replaces the page in a build without Node.
#include "viewer_page.h"

namespace cellwalk::cli {

const std::string_view viewer_page = "";

}  // namespace cellwalk::cli
