// SPDX-License-Identifier: Apache-2.0
#include "cli/instruction_set.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <stdlib.h>

#include "base/error.h"

namespace theatron::cli {
namespace {

class InstructionSet : public ::testing::Test {
protected:
    ~InstructionSet() override {
        unsetenv(instruction_set_variable);
        hwy::SetSupportedTargetsForTest(0);
    }
    static void hold_to(const std::string& name) {
        setenv(instruction_set_variable, name.c_str(), 1);
        hold_to_instruction_set();
    }
};

TEST_F(InstructionSet, EveryOneOfTheMachineCanBeHeldTo) {
    const std::string best = instruction_set_in_use();
    std::string names = known_instruction_sets() + ", ";
    for (std::size_t comma; (comma = names.find(", ")) != std::string::npos;
         names.erase(0, comma + 2)) {
        const std::string name = names.substr(0, comma);
        hold_to(name);
        EXPECT_EQ(instruction_set_in_use(), name);
        hwy::SetSupportedTargetsForTest(0);
        EXPECT_EQ(instruction_set_in_use(), best);
    }
}

TEST_F(InstructionSet, WithoutTheVariableNothingIsHeld) {
    const std::string all = known_instruction_sets();
    unsetenv(instruction_set_variable);
    hold_to_instruction_set();
    EXPECT_EQ(known_instruction_sets(), all);
    hold_to("");
    EXPECT_EQ(known_instruction_sets(), all);
}

TEST_F(InstructionSet, AnUnknownOneIsRefusedWithThoseThatAreThere) {
    try {
        hold_to("AVX9");
        FAIL() << "it was taken";
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("THEATRON_TARGETS=AVX9"), std::string::npos);
        EXPECT_NE(std::string(e.what()).find(known_instruction_sets()), std::string::npos);
    }
}

}  // namespace
}  // namespace theatron::cli
