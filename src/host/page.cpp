// SPDX-License-Identifier: Apache-2.0
#include "host/page.h"

#include <fstream>
#include <sstream>

#include "base/error.h"

namespace theatron::host {
namespace {

// Nothing from elsewhere, no script or style within the page, no frame around it, no plug-ins, no
// form to elsewhere; WebAssembly is compiled. Its address is told to nobody.
const std::vector<std::pair<std::string, std::string>>& strict_headers() {
    static const std::vector<std::pair<std::string, std::string>> headers = {
        {"Content-Security-Policy",
         "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; "
         "img-src 'self'; connect-src 'self'; base-uri 'none'; form-action 'none'; "
         "frame-ancestors 'none'"},
        {"Cross-Origin-Opener-Policy", "same-origin"},
        {"Cross-Origin-Embedder-Policy", "require-corp"},
        {"Cross-Origin-Resource-Policy", "same-origin"},
        {"Referrer-Policy", "no-referrer"},
        {"Permissions-Policy",
         "camera=(self), display-capture=(self), geolocation=(), microphone=(self), payment=(), "
         "usb=(), fullscreen=(self), "
         "xr-spatial-tracking=(self)"},
    };
    return headers;
}

std::shared_ptr<const std::string> content_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream content;
    if (!(content << in.rdbuf()))
        throw Error("The browser client's file '" + file.string() +
                    "' cannot be read; build it again with: make build");
    return std::make_shared<const std::string>(std::move(content).str());
}

// Empty if there is no such number.
std::string sources_number(const std::filesystem::path& folder) {
    std::ifstream in(folder / "web_sources.txt");
    std::string number;
    in >> number;
    return number;
}

}  // namespace

Page::Page(const std::filesystem::path& folder) {
    std::ifstream list(folder / "files.txt");
    std::string path, type, name;
    while (list >> path >> type >> name)
        files_[path] = {type, content_of(folder / name), content_of(folder / (name + ".gz")),
                        content_of(folder / (name + ".br"))};
    // `folder` may be a link to elsewhere; its parent is the program's folder all the same.
    const std::string own = sources_number(folder), expected = sources_number(folder.parent_path());
    if (!empty() && !own.empty() && !expected.empty() && own != expected)
        problem_ =
            "The browser client was built from other sources than this program; build both with: "
            "make build";
    std::ifstream missing(folder / "missing.txt");
    std::string names;
    if (problem_.empty() && std::getline(missing, names) && !names.empty())
        problem_ =
            "The browser client was built without these libraries, because their sources could not "
            "be fetched: " +
            names + "; with a network, build it again with: make build";
}

std::optional<net::HttpAnswer> Page::answer(const net::HttpRequest& request) const {
    const std::string_view path = net::path_of(request.target);
    const auto found = files_.find(path);
    if (found == files_.end())
        return std::nullopt;
    const File& file = found->second;
    net::HttpAnswer answer{.type = file.type, .file = file.plain, .headers = strict_headers()};
    const auto use = [&](const char* coding, const Content& content) {
        const bool can = net::accepts_encoding(request.accept_encoding, coding);
        if (can) {
            answer.file = content;
            answer.headers.emplace_back("Content-Encoding", coding);
        }
        return can;
    };
    if (!use("br", file.brotli))
        use("gzip", file.gzip);
    answer.headers.emplace_back("Vary", "Accept-Encoding");
    // All names but those of pages contain the hash of the content.
    const bool is_page = file.type.starts_with("text/html");
    answer.headers.emplace_back("Cache-Control",
                                is_page ? "no-cache" : "public, max-age=31536000, immutable");
    return answer;
}

bool has_page(const std::filesystem::path& folder) {
    std::error_code none;
    return !folder.empty() && std::filesystem::exists(folder / "files.txt", none);
}

std::filesystem::path page_folder_of(const std::filesystem::path& program_folder) {
    const std::filesystem::path built = program_folder / "web",
                                installed = program_folder.parent_path() / "share/theatron/page";
    std::error_code none;
    // A build makes the link before the page.
    const bool will_be_built = std::filesystem::is_symlink(built, none) && !has_page(installed);
    return has_page(built) || will_be_built ? built : installed;
}

std::filesystem::path usual_page_folder() {
    std::error_code error;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
    return error ? std::filesystem::path() : page_folder_of(program.parent_path());
}

}  // namespace theatron::host
