// SPDX-License-Identifier: Apache-2.0
#include "filter/chain.h"

#include <algorithm>
#include <cassert>

namespace theatron::filter {

struct Chain::State {
    ChainSettings settings;
    Size size;
};

Chain::Chain(const ChainSettings& settings, const ChainCamera& camera)
    : state_(std::make_unique<State>(State{settings, camera.size})) {}
Chain::~Chain() = default;
Chain::Chain(Chain&&) noexcept = default;
Chain& Chain::operator=(Chain&&) noexcept = default;

Size Chain::size() const {
    return state_->size;
}
bool Chain::off() const {
    return state_->settings.off();
}

void Chain::apply(DepthView in, MutableDepthView out, Duration) {
    assert(in.size == state_->size && out.size == state_->size);
    for (int y = 0; y < in.size.height; ++y)
        std::copy_n(in.row(y), in.size.width, out.row(y));
}

}  // namespace theatron::filter
