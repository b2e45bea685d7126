// SPDX-License-Identifier: LGPL-3.0-or-later
// The motions of the traces of figure 8.
#ifndef CELLWALK_EXPERIMENTS_FIGURE_8_MOTIONS_H
#define CELLWALK_EXPERIMENTS_FIGURE_8_MOTIONS_H

#include <cellwalk/environment/snapshot.h>

#include "trace_maker.h"

namespace cellwalk::figure_8 {

/// Record a motion, from a trace that has its grid and bodies, which stand nowhere yet.
/// \throw as make_trace()
Made_trace record_deforming(const Snapshot<3>& snapshot, Body_trace start, const Trace_options& options);
Made_trace record_rigid(const Snapshot<3>& snapshot, Body_trace start, const Trace_options& options);

}  // namespace cellwalk::figure_8

#endif  // CELLWALK_EXPERIMENTS_FIGURE_8_MOTIONS_H
