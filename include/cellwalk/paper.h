// SPDX-License-Identifier: LGPL-3.0-or-later
// For those who repeat the paper: number policies that Exact is compared with, strategies of the walk, and
// searches for the contacts of edges. Others need none of it: <cellwalk/cellwalk.h> decides and locates
// exactly.
#ifndef CELLWALK_PAPER_H
#define CELLWALK_PAPER_H

#include <cellwalk/edge/contact_search.h>
#include <cellwalk/kernel/policies.h>
#include <cellwalk/walk/strategy.h>

#endif  // CELLWALK_PAPER_H
