// SPDX-License-Identifier: Apache-2.0
#include "net/places.h"

#include <algorithm>
#include <boost/asio/ip/address.hpp>

namespace theatron::net {
namespace {

constexpr double burst_seconds = 0.1;
// Addresses whose budget is full again need not be remembered.
constexpr std::size_t max_budgets = 2 * Places::max_pending;

}  // namespace

void Places::Budget::fill(double per_second, TimePoint now) {
    const double most = per_second * burst_seconds;
    left =
        filled == TimePoint{} ? most : std::min(most, left + to_seconds(now - filled) * per_second);
    filled = now;
}

Places::Entered Places::take(Entry entry) {
    Entered entered{Id{next_id_++}, make_room(entry.known)};
    entries_[entered.id] = std::move(entry);
    return entered;
}

std::optional<Places::Id> Places::make_room(bool known) {
    const auto same = std::size_t(std::ranges::count_if(
        entries_, [&](const auto& entry) { return entry.second.known == known; }));
    if (same < max_pending)
        return std::nullopt;
    const auto evicted = longest_of_the_largest(known);
    leave(*evicted);
    return evicted;
}

Places::Entered Places::enter(const std::string& address) {
    return take({.address = address, .known = is_known(address)});
}

Places::Entered Places::enter_of_proxy(const std::string& address) {
    return take({.address = address, .known = true, .is_of_proxy = true});
}

std::optional<Places::Id> Places::act_for(Id id, const std::string& address) {
    const auto found = entries_.find(id);
    if (found == entries_.end())
        return std::nullopt;
    const bool known = is_known(address);
    std::optional<Id> evicted;
    // A known address and a proxy's own connections share their places.
    if (!known)
        evicted = make_room(known);
    found->second.address = address;
    found->second.known = known;
    found->second.is_of_proxy = false;
    return evicted;
}

void Places::leave(Id id) {
    const auto found = entries_.find(id);
    if (found == entries_.end())
        return;
    waiting_ -= found->second.waits;
    entries_.erase(found);
}

std::optional<Places::Id> Places::longest_of_the_largest(bool known) const {
    std::map<std::string, std::pair<std::size_t, Id>> groups;  // how many, and the oldest
    for (const auto& [id, entry] : entries_)
        if (entry.known == known)
            ++groups.try_emplace(entry.address, 0, id).first->second.first;
    std::optional<Id> chosen;
    std::size_t most = 0;
    for (const auto& [address, group] : groups) {
        const auto [count, oldest] = group;
        if (count > most || (count == most && oldest < *chosen)) {
            most = count;
            chosen = oldest;
        }
    }
    return chosen;
}

std::optional<Places::Id> Places::next_to_go() const {
    const auto stranger = longest_of_the_largest(false);
    return stranger ? stranger : longest_of_the_largest(true);
}

void Places::note_known(const std::string& address) {
    known_[address] = ++heard_;
    if (known_.size() > max_known)
        known_.erase(
            std::ranges::min_element(known_, {}, [](const auto& entry) { return entry.second; }));
}

void Places::note_wrong_token(const std::string& address, TimePoint now) {
    if (is_known(address))
        return;
    Budget& own = by_address_[address];
    own.fill(handshakes_per_second_and_address, now);
    own.left = std::max(own.left - wrong_token_cost, -max_wrong_token_debt);
}

void Places::want_handshake(Id id) {
    const auto found = entries_.find(id);
    if (found == entries_.end() || found->second.waits)
        return;
    found->second.waits = true;
    ++waiting_;
}

void Places::refill(TimePoint now) {
    strangers_.fill(handshakes_per_second, now);
    regulars_.fill(handshakes_per_second, now);
    proxies_.fill(handshakes_per_second, now);
    for (auto& [address, budget] : by_address_)
        budget.fill(handshakes_per_second_and_address, now);
    if (by_address_.size() > max_budgets)
        std::erase_if(by_address_, [](const auto& b) {
            return b.second.left >= handshakes_per_second_and_address * burst_seconds;
        });
}

std::optional<Places::Id> Places::next_handshake(TimePoint now) {
    if (waiting_ == 0)
        return std::nullopt;
    refill(now);
    std::map<Id, Entry>::iterator chosen = entries_.end();
    Budget* budget = nullptr;
    for (const bool known : {true, false}) {
        if ((known ? regulars_ : strangers_).left < 1)
            continue;
        for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
            if (!entry->second.waits || entry->second.known != known)
                continue;
            Budget& own = entry->second.is_of_proxy ? proxies_ : by_address_[entry->second.address];
            if (own.filled == TimePoint{})
                own.fill(handshakes_per_second_and_address, now);
            if (own.left >= 1 && (!budget || own.left > budget->left)) {
                chosen = entry;
                budget = &own;
            }
        }
        if (budget) {
            (known ? regulars_ : strangers_).left -= 1;
            break;
        }
    }
    if (!budget)
        return std::nullopt;
    budget->left -= 1;
    chosen->second.waits = false;
    --waiting_;
    return chosen->first;
}

std::string address_group(const std::string& text) {
    boost::system::error_code error;
    const auto address = boost::asio::ip::make_address(text, error);
    if (error || !address.is_v6())
        return text;
    const auto six = address.to_v6();
    if (six.is_v4_mapped())
        return boost::asio::ip::make_address_v4(boost::asio::ip::v4_mapped, six).to_string();
    auto bytes = six.to_bytes();
    std::fill(bytes.begin() + 8, bytes.end(), 0);
    return boost::asio::ip::address_v6(bytes).to_string() + "/64";
}

}  // namespace theatron::net
