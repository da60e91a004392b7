// SPDX-License-Identifier: Apache-2.0
#include "viewer/text_draft.h"

#include <gtest/gtest.h>

namespace theatron::viewer {
namespace {

using window::FormKey;

TEST(TextDraft, TakesLettersAndLosesWholeCharacters) {
    TextDraft draft(20);
    EXPECT_EQ(draft.take({FormKey::letters, false, false, "Gefäß ö"}), TextDraft::Result::goes_on);
    (void)draft.take({FormKey::backspace});
    (void)draft.take({FormKey::backspace});
    (void)draft.take({FormKey::backspace});
    EXPECT_EQ(draft.text(), "Gefä");
    (void)draft.take({FormKey::backspace});
    EXPECT_EQ(draft.text(), "Gef");
    for (int i = 0; i < 9; ++i)
        (void)draft.take({FormKey::backspace});
    EXPECT_EQ(draft.text(), "");
}

TEST(TextDraft, HasALimitAndOneLineWithoutControlCharacters) {
    TextDraft draft(5);
    (void)draft.take({FormKey::letters, false, false, "a\nb\tcdefgh"});
    EXPECT_EQ(draft.text(), "a b c");
}

TEST(TextDraft, EndsByEnterOrEsc) {
    TextDraft draft(5);
    EXPECT_EQ(draft.take({FormKey::enter}), TextDraft::Result::finished);
    EXPECT_EQ(draft.take({FormKey::escape}), TextDraft::Result::given_up);
    EXPECT_EQ(draft.take({FormKey::left}), TextDraft::Result::goes_on);
}

}  // namespace
}  // namespace theatron::viewer
