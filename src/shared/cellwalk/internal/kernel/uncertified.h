// SPDX-License-Identifier: LGPL-3.0-or-later
// Decisions contradict each other only in environments that are not certified, such as compiled ones that
// were forged: code that relies on their proofs ends there, instead of going on for ever or reading
// elsewhere.
#ifndef CELLWALK_INTERNAL_KERNEL_UNCERTIFIED_H
#define CELLWALK_INTERNAL_KERNEL_UNCERTIFIED_H

namespace cellwalk {

/// \throw Error(not_certified)
[[noreturn]] void refuse_uncertified();

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_KERNEL_UNCERTIFIED_H
