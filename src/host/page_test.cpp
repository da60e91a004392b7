// SPDX-License-Identifier: Apache-2.0
#include "host/page.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/error.h"
#include "testing/temporary_folder.h"

namespace theatron::host {
namespace {

class PageTest : public ::testing::Test {
protected:
    void write(const std::string& name, const std::string& content) {
        std::ofstream(folder.path() / name, std::ios::binary) << content;
    }
    void write_page() {
        write("files.txt",
              "/ text/html;charset=utf-8 index.html\n/operators text/html;charset=utf-8 "
              "operators.html\n/a.12.js text/javascript a.12.js\n");
        for (const std::string name : {"index.html", "operators.html", "a.12.js"})
            for (const std::string ending : {"", ".gz", ".br"})
                write(name + ending, name + ending + " content");
    }
    static std::string header(const net::HttpAnswer& answer, const std::string& name) {
        for (const auto& [known, value] : answer.headers)
            if (known == name)
                return value;
        return "";
    }

    testing::TemporaryFolder folder;
};

TEST_F(PageTest, GivesTheBestCodingThatTheBrowserAccepts) {
    write_page();
    const Page page(folder.path());
    const auto content = [&](const std::string& accepted) {
        return *page.answer({"/a.12.js", "", accepted})->file;
    };
    EXPECT_EQ(content("gzip, br"), "a.12.js.br content");
    EXPECT_EQ(content("gzip"), "a.12.js.gz content");
    EXPECT_EQ(content(""), "a.12.js content");
    EXPECT_EQ(header(*page.answer({"/a.12.js", "", "br"}), "Content-Encoding"), "br");
    EXPECT_EQ(header(*page.answer({"/a.12.js", "", ""}), "Content-Encoding"), "");
}

TEST_F(PageTest, IsKeptByBrowsersExceptItsPages) {
    write_page();
    const Page page(folder.path());
    EXPECT_EQ(header(*page.answer({"/", "", ""}), "Cache-Control"), "no-cache");
    EXPECT_EQ(header(*page.answer({"/operators", "", ""}), "Cache-Control"), "no-cache");
    EXPECT_EQ(header(*page.answer({"/a.12.js", "", ""}), "Cache-Control"),
              "public, max-age=31536000, immutable");
}

TEST_F(PageTest, AllowsNothingFromElsewhereAndNoScriptWithinThePage) {
    write_page();
    const auto answer = Page(folder.path()).answer({"/?a=b", "", ""});
    ASSERT_TRUE(answer);
    const std::string policy = header(*answer, "Content-Security-Policy");
    EXPECT_TRUE(policy.starts_with("default-src 'none';")) << policy;
    for (const char* open : {"unsafe-inline", "'unsafe-eval'", "*", "http:", "https:", "data:"})
        EXPECT_EQ(policy.find(open), policy.npos) << open;
    EXPECT_EQ(header(*answer, "Cross-Origin-Opener-Policy"), "same-origin");
    EXPECT_EQ(header(*answer, "Cross-Origin-Embedder-Policy"), "require-corp");
    EXPECT_EQ(header(*answer, "Cross-Origin-Resource-Policy"), "same-origin");
}

TEST_F(PageTest, HasOnlyListedFiles) {
    write_page();
    write("secret", "secret");
    const Page page(folder.path());
    for (const char* target : {"/secret", "/files.txt", "/../secret", "/a.12.js/", "//", "",
                               "/a.12.js.br", "/index.html", "/%61.12.js"})
        EXPECT_FALSE(page.answer({target, "", "br"})) << target;
}

TEST_F(PageTest, KnowsWhatItWasBuiltFrom) {
    const std::filesystem::path program = folder.path() / "program",
                                built = folder.path() / "built";
    std::filesystem::create_directories(program);
    std::filesystem::create_directories(built);
    // As in a build's folder: the page lies elsewhere.
    std::filesystem::create_symlink(built, program / "web");
    const auto problem = [&] { return Page(program / "web").problem(); };
    write("built/files.txt", "");
    EXPECT_EQ(problem(), "");
    for (const char* name : {"a.js", "a.js.gz", "a.js.br"})
        write(std::string("built/") + name, "content");
    write("built/files.txt", "/a.js text/javascript a.js\n");
    EXPECT_EQ(problem(), "");
    write("built/web_sources.txt", "12\n");
    write("web_sources.txt", "13\n");
    EXPECT_EQ(problem(), "");
    write("program/web_sources.txt", "12\n");
    EXPECT_EQ(problem(), "");
    write("program/web_sources.txt", "13\n");
    EXPECT_NE(problem().find("make build"), std::string::npos);
    write("program/web_sources.txt", "12\n");
    write("built/missing.txt", "\n");
    EXPECT_EQ(problem(), "");
    write("built/missing.txt", "opus, lz4\n");
    EXPECT_NE(problem().find("opus, lz4"), std::string::npos);
}

TEST_F(PageTest, LiesBesideABuiltProgramOrWhereItIsInstalled) {
    const std::filesystem::path prefix = folder.path() / "usr", program = prefix / "bin",
                                installed = prefix / "share/theatron/page";
    std::filesystem::create_directories(program);
    std::filesystem::create_directories(installed);
    EXPECT_EQ(page_folder_of(program), installed);
    EXPECT_FALSE(has_page(installed));
    // A link of a build whose page is still to come.
    std::filesystem::create_symlink(folder.path() / "nowhere", program / "web");
    EXPECT_EQ(page_folder_of(program), program / "web");
    write("usr/share/theatron/page/files.txt", "");
    EXPECT_TRUE(has_page(installed));
    EXPECT_EQ(page_folder_of(program), installed);
    std::filesystem::remove(program / "web");
    std::filesystem::create_directories(program / "web");
    write("usr/bin/web/files.txt", "");
    EXPECT_EQ(page_folder_of(program), program / "web");
}

TEST_F(PageTest, WithoutAFolderThereIsNoPage) {
    EXPECT_TRUE(Page(folder.path()).empty());
    EXPECT_TRUE(Page(std::filesystem::path()).empty());
    EXPECT_FALSE(Page().answer({"/", "", ""}));
}

TEST_F(PageTest, AListedFileThatIsMissingIsNamed) {
    write("files.txt", "/ text/html index.html\n");
    try {
        const Page page(folder.path());
        FAIL();
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("index.html"), std::string::npos) << e.what();
    }
}

}  // namespace
}  // namespace theatron::host
