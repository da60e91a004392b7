// SPDX-License-Identifier: Apache-2.0
#include "manual.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/choice_check.h"

namespace theatron::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Manual : public ::testing::Test {
protected:
    Manual() {
        CLI::App* host = app.add_subcommand("host", "Stream cameras. To those who join");
        host->add_option("--admit", admit, "Who: [everybody] or 'some' of v1.5; or none")
            ->check(cli::one_of({"all", "ask"}))
            ->capture_default_str();
        host->add_option("--camera", cameras, "A camera");
        host->add_option("--secret", secret)->group("");
        host->footer("Lines:\n.camera at the beginning\n  a\\b");
        CLI::App* session = app.add_subcommand("session", "Sessions");
        session->add_subcommand("create", "Open one")->add_option("name", name)->required();
    }
    CLI::App app{"A program.\n\nMore of it."};
    std::string admit = "all", secret, name;
    std::vector<std::string> cameras;
};

TEST_F(Manual, APageSaysWhatHelpSays) {
    const std::string page = manual_page(app, *app.get_subcommand("host"), "1.2");
    EXPECT_THAT(page, HasSubstr(".TH \"theatron-host\" 1 \"\" \"Theatron 1.2\""));
    EXPECT_THAT(page, HasSubstr("theatron\\-host \\- Stream cameras. To those who join\n"));
    EXPECT_THAT(page, HasSubstr("\\fB\\-\\-admit\\fR all|ask\nWho: [everybody] or 'some' of v1.5; "
                                "or none (default: all)\n"));
    EXPECT_THAT(page, HasSubstr("\\fB\\-\\-camera\\fR"));
    EXPECT_THAT(page, Not(HasSubstr("secret")));
}

TEST_F(Manual, TextIsNeverTakenForRequests) {
    const std::string page = manual_page(app, *app.get_subcommand("host"), "1.2");
    EXPECT_THAT(page, HasSubstr("\n\\&.camera at the beginning\n"));
    EXPECT_THAT(page, HasSubstr("\n  a\\eb\n"));
}

TEST_F(Manual, ThePageOfTheProgramListsItsCommandsAndThatOfACommandItsOwn) {
    EXPECT_THAT(manual_page(app, app, "1.2"),
                HasSubstr("\\fBtheatron\\-host\\fR(1)\nStream cameras. To those who join\n"));
    const std::string page = manual_page(app, *app.get_subcommand("session"), "1.2");
    EXPECT_THAT(page, HasSubstr(".SS theatron session create\n"));
    EXPECT_THAT(page, HasSubstr("[\\fIOPTION\\fR]... \\fIname\\fR\n"));
}

TEST_F(Manual, ShellsKnowCommandsOptionsAndValues) {
    const std::string bash = bash_completion(app);
    EXPECT_THAT(bash, HasSubstr("compgen -W 'host session -h --help'"));
    EXPECT_THAT(bash, HasSubstr("'host '*' --admit') words='all ask' ;;"));
    EXPECT_THAT(bash, HasSubstr("session) words='create' ;;"));
    EXPECT_THAT(bash, Not(HasSubstr("secret")));
    const std::string zsh = zsh_completion(app);
    EXPECT_THAT(zsh, HasSubstr("'host:Stream cameras'"));
    EXPECT_THAT(zsh, HasSubstr("'--admit[Who\\: (everybody) or '\\''some'\\'' of v1.5]"
                               ":value:(all ask)'"));
    EXPECT_THAT(zsh, HasSubstr("'*--camera[A camera]:value:_files'"));
}

}  // namespace
}  // namespace theatron::app
