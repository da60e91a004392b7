// SPDX-License-Identifier: Apache-2.0
#include "host/link_keeper.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/log.h"

namespace theatron::host {

LinkKeeper::LinkKeeper(Options options)
    : folder_(std::move(options.folder)),
      roles_expire_(options.roles_expire),
      own_token_(std::move(options.own_token)) {
    make_role_links(folder_);
    load({});
}

bool LinkKeeper::follow(TimePoint now) {
    const bool is_other = look_at_links(folder_) != seen_;
    bool tries_again = false;
    {
        const std::lock_guard lock(mutex_);
        tries_again = (!problems_.empty() || !unsaved_.empty()) && now >= next_try_;
        if (tries_again)
            next_try_ = now + again_after;
    }
    if (!is_other && !tries_again)
        return false;
    if (tries_again)
        save_revocations();
    const auto before = tokens();
    load(now);
    return is_other || tokens() != before;
}

void LinkKeeper::load(TimePoint now) {
    const std::lock_guard making(making_);
    // Looked at before they are read: a change meanwhile is seen the next time.
    seen_ = look_at_links(folder_);
    KnownLinks book = load_links(folder_);
    const std::lock_guard lock(mutex_);
    links_.clear();
    for (const KnownLink& known : book.links) {
        // 'theatron link --revoke' changes the token that the own one replaces.
        const bool is_of_experts = known.name == wire::text_of(wire::Role::expert);
        if (is_of_experts && replaced_.empty())
            replaced_ = known.token;
        if (is_of_experts && replaced_ != known.token && !own_token_.empty())
            revoked_.insert(std::exchange(own_token_, {}));
        const bool is_own = is_of_experts && !own_token_.empty();
        const std::string& secret = is_own ? own_token_ : known.token;
        if (revoked_.contains(secret) || unsaved_.contains(known.name))
            continue;
        links_.push_back(known);
        links_.back().token = secret;
    }
    std::erase_if(makers_, [&](const auto& entry) {
        return std::ranges::none_of(links_, [&](const auto& l) { return l.name == entry.first; });
    });
    if (book.problems != problems_) {
        for (const std::string& problem : book.problems)
            log::warning("host", "a link admits nobody", {{"problem", problem}});
        if (book.problems.empty())
            log::info("host", "all links can be read again");
    }
    if (problems_.empty())
        next_try_ = std::max(next_try_, now + again_after);
    problems_ = std::move(book.problems);
}

void LinkKeeper::tell_followed(TimePoint now) {
    if (told_ == seen_ || now < next_tell_)
        return;
    try {
        tell_links_followed(folder_, seen_);
        told_ = seen_;
    } catch (const Error&) {
        // 'theatron link --revoke' says that the host did not answer.
        next_tell_ = now + again_after;
    }
}

std::vector<session::Admission::Token> LinkKeeper::tokens() const {
    std::vector<session::Admission::Token> tokens;
    for (const KnownLink& link : links()) {
        const bool is_of_role = wire::parse_role(link.name).has_value();
        tokens.push_back({link.token, link.role, is_of_role ? roles_expire_ : std::nullopt,
                          link.name, link.expires});
    }
    return tokens;
}

std::vector<KnownLink> LinkKeeper::links() const {
    const std::lock_guard lock(mutex_);
    return links_;
}

KnownLink LinkKeeper::make(wire::Role role, std::optional<files::UtcSeconds> expires,
                           const std::string& label, const std::string& maker) {
    const std::lock_guard making(making_);
    KnownLink link = make_link(folder_, role, expires, label);
    const std::lock_guard lock(mutex_);
    makers_[link.name] = maker;
    // It admits people at once; follow() reads it again.
    links_.push_back(link);
    return link;
}

std::map<std::string, std::string> LinkKeeper::makers() const {
    const std::lock_guard lock(mutex_);
    return makers_;
}

void LinkKeeper::revoke(const std::string& link, TimePoint now) {
    {
        const std::lock_guard lock(mutex_);
        for (const KnownLink& known : links_)
            if (known.name == link)
                revoked_.insert(known.token);
        std::erase_if(links_, [&](const auto& known) { return known.name == link; });
        if (link == wire::text_of(wire::Role::expert))
            own_token_.clear();
        unsaved_.insert(link);
        next_try_ = now + again_after;
    }
    save_revocations();
    const std::lock_guard lock(mutex_);
    if (unsaved_.contains(link))
        log::error("host", "a revoked link would be valid again after a restart",
                   {{"link", link}, {"problem", save_problem_}});
}

void LinkKeeper::save_revocations() {
    std::set<std::string> unsaved;
    {
        const std::lock_guard lock(mutex_);
        unsaved = unsaved_;
    }
    std::string problem;
    for (const std::string& link : unsaved) {
        try {
            (void)revoke_link(folder_, link);
            const std::lock_guard lock(mutex_);
            unsaved_.erase(link);
        } catch (const Error& error) {
            problem = error.what();
        }
    }
    const std::lock_guard lock(mutex_);
    save_problem_ = std::move(problem);
}

std::string LinkKeeper::problem() const {
    const std::lock_guard lock(mutex_);
    std::string text;
    if (!unsaved_.empty())
        text =
            "A revoked link admits nobody, but would after a restart of the host: " + save_problem_;
    if (!problems_.empty())
        text += (text.empty() ? "" : " ") + ("A link admits nobody. " + problems_.front());
    if (problems_.size() > 1)
        text += " " + std::to_string(problems_.size() - 1) +
                " more cannot be used; 'theatron link --list' names them.";
    return text;
}

}  // namespace theatron::host
