// SPDX-License-Identifier: LGPL-3.0-or-later
// The page into which `cellwalk view` inserts a run. Its source is in viewer/.
#ifndef CELLWALK_CLI_COMMON_VIEWER_PAGE_H
#define CELLWALK_CLI_COMMON_VIEWER_PAGE_H

#include <string_view>

namespace cellwalk::cli {

/// HTML with its styles and scripts; empty in a build without Node. Data replace the first /*RUN*/ (JSON),
/// /*CONTACTS*/ and /*MOTION*/ (base64).
extern const std::string_view viewer_page;

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_COMMON_VIEWER_PAGE_H
