// SPDX-License-Identifier: Apache-2.0
#include "host/late_page.h"

#include "base/error.h"
#include "base/log.h"

namespace theatron::host {
namespace {

std::shared_ptr<const Page> load(const std::filesystem::path& folder) {
    auto page =
        folder.empty() ? std::make_shared<const Page>() : std::make_shared<const Page>(folder);
    if (!page->problem().empty())
        log::warning("host", "page", {{"problem", page->problem()}});
    return page;
}

}  // namespace

LatePage::LatePage(std::filesystem::path folder)
    : folder_(std::move(folder)), page_(load(folder_)) {}

std::shared_ptr<const Page> LatePage::current() {
    const std::lock_guard lock(mutex_);
    if (!page_->empty() || !has_page(folder_))
        return page_;
    try {
        page_ = load(folder_);
    } catch (const Error&) {
        // The build removes an older page before it writes the new one: the next request tries
        // again.
    }
    return page_;
}

}  // namespace theatron::host
