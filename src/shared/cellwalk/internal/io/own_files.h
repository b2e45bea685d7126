// SPDX-License-Identifier: LGPL-3.0-or-later
// Folders in which a program goes on with the work of another one: nothing that is written or removed there
// reaches a file outside, whoever made the folder.
#ifndef CELLWALK_INTERNAL_IO_OWN_FILES_H
#define CELLWALK_INTERNAL_IO_OWN_FILES_H

#include <filesystem>
#include <string>

namespace cellwalk::io {

/// Refuses a folder that holds, at any depth, anything but folders and files of one name: a link, symbolic or
/// hard, leads to files elsewhere, and opening a pipe or a device may wait or act.
/// \param shown its name in the message
/// \throw Error(input) naming the first of them; Error(other) if a folder cannot be read
void check_own(const std::filesystem::path& folder, const std::string& shown);

/// Opens a file of one name without following a link, as open(2) with permissions for all. Returns -1 and
/// sets errno where that fails, to ELOOP or EMLINK for another kind of entry.
int open_own(const std::filesystem::path& file, int flags);

/// Removes a file, or a folder with all that is in it, and follows no link. Returns whether nothing is left.
/// Allocates nothing, and is safe in a signal handler.
bool remove_tree(const char* path) noexcept;

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_OWN_FILES_H
