// SPDX-License-Identifier: Apache-2.0
// The browser client that a host serves: files that apps/web/pack.mjs packed.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "net/http.h"

namespace theatron::host {

// Does not change after its construction; any thread.
class Page {
public:
    // Without files: the host was built without the browser client.
    Page() = default;
    // The files that `folder`/files.txt lists, in memory. Without that list: none. Throws Error if
    // a listed file is missing.
    explicit Page(const std::filesystem::path& folder);

    bool empty() const { return files_.empty(); }
    // One sentence if the page was built from other sources than the program in the folder above,
    // by web_sources.txt in both (cmake/WebSources.cmake), or without libraries, by missing.txt;
    // otherwise empty.
    const std::string& problem() const { return problem_; }

    // nullopt if there is nothing at this path. Only listed paths are found, whatever the request.
    std::optional<net::HttpAnswer> answer(const net::HttpRequest& request) const;

private:
    using Content = std::shared_ptr<const std::string>;
    struct File {
        std::string type;
        Content plain, gzip, brotli;
    };
    std::map<std::string, File, std::less<>> files_;  // by path
    std::string problem_;
};

// True if Page(folder) would have files.
bool has_page(const std::filesystem::path& folder);

// The folder of the page of a program: `web` beside it where it was or will be built, else
// share/theatron/page where it was installed (PREFIX/bin/theatron). There need not be anything.
std::filesystem::path page_folder_of(const std::filesystem::path& program_folder);

// That of this program. Empty if its place cannot be found out.
std::filesystem::path usual_page_folder();

}  // namespace theatron::host
