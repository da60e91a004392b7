// SPDX-License-Identifier: Apache-2.0
// The GL context of this folder's tests. Where there is none the tests fail and
// say what to install: a renderer that never draws is not tested.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <string_view>

#include "render/offscreen_context_native.h"

namespace theatron::render {

// All tests run twice: with THEATRON_TEST_GL=desktop_core on OpenGL's core profile.
inline GlKind tested_gl() {
    const char* kind = std::getenv("THEATRON_TEST_GL");
    return kind && std::string_view(kind) == "desktop_core" ? GlKind::desktop_core : GlKind::es;
}

// No test may make an error of the driver's on the context that all share.
class NoGlErrors : public ::testing::EmptyTestEventListener {
public:
    explicit NoGlErrors(const OffscreenContext& context) : context_(context) {}
    void OnTestEnd(const ::testing::TestInfo&) override {
        if (context_.errors() != before_)
            ADD_FAILURE() << "The driver reported errors; the first: " << context_.first_error();
        before_ = context_.errors();
    }

private:
    const OffscreenContext& context_;
    int before_ = 0;
};

// Made once, as a driver's start takes most of the tests' time, and current on return.
inline OffscreenContext& test_context() {
    static OffscreenContext context(tested_gl());
    [[maybe_unused]] static const bool watched = [] {
        ::testing::UnitTest::GetInstance()->listeners().Append(new NoGlErrors(context));
        return true;
    }();
    context.make_current();
    return context;
}

}  // namespace theatron::render
