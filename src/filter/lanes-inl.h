// SPDX-License-Identifier: Apache-2.0
// Comparisons of unsigned lanes missing in Highway. Included once per instruction set.
#if defined(THEATRON_FILTER_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef THEATRON_FILTER_LANES_INL_H
#undef THEATRON_FILTER_LANES_INL_H
#else
#define THEATRON_FILTER_LANES_INL_H
#endif

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace theatron::filter::HWY_NAMESPACE {

template <class V>
HWY_INLINE auto at_most(V a, V b) {
    return hwy::HWY_NAMESPACE::Eq(hwy::HWY_NAMESPACE::Min(a, b), a);
}
template <class V>
HWY_INLINE auto at_least(V a, V b) {
    return at_most(b, a);
}

}  // namespace theatron::filter::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
