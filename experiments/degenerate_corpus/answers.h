// SPDX-License-Identifier: LGPL-3.0-or-later
// What Cellwalk answers to the cases of a corpus.
#ifndef CELLWALK_EXPERIMENTS_DEGENERATE_CORPUS_ANSWERS_H
#define CELLWALK_EXPERIMENTS_DEGENERATE_CORPUS_ANSWERS_H

#include <cellwalk/edge/sweep.h>

#include <filesystem>

namespace cellwalk::corpus {

/// Reads all cases of a folder, moves what they describe by the library alone, and writes a row for each.
void answer(const std::filesystem::path& folder, Touch touch, const std::filesystem::path& table);

}  // namespace cellwalk::corpus

#endif  // CELLWALK_EXPERIMENTS_DEGENERATE_CORPUS_ANSWERS_H
