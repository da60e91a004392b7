// SPDX-License-Identifier: Apache-2.0
#include "session/content_fetch.h"

#include <gtest/gtest.h>

#include <random>

namespace theatron::session {
namespace {

using namespace std::chrono_literals;
using Wanted = ContentFetch::Wanted;
using Failure = ContentFetch::Failure;

// Not a good hash, but it depends on every byte and its place.
class SmallDigest final : public ContentDigest {
public:
    void add(ByteView piece) override {
        for (const std::byte b : piece)
            state_ = (state_ ^ std::to_integer<std::uint64_t>(b)) * 0x100000001b3;
    }
    ContentHash finish() override {
        ContentHash hash;
        store_le(hash.bytes.data(), state_);
        return hash;
    }

private:
    std::uint64_t state_ = 0xcbf29ce484222325;
};

std::unique_ptr<ContentDigest> make_digest() {
    return std::make_unique<SmallDigest>();
}

ContentHash hash_of(ByteView bytes) {
    SmallDigest digest;
    digest.add(bytes);
    return digest.finish();
}

Bytes content_of(std::size_t size, unsigned seed) {
    std::mt19937 random(seed);
    Bytes bytes(size);
    for (std::byte& b : bytes)
        b = std::byte(random());
    return bytes;
}

// A host that answers requests in order, in pieces.
class SmallHost {
public:
    ContentHash add(Bytes bytes) {
        const ContentHash hash = hash_of(bytes);
        content_[hash] = std::move(bytes);
        return hash;
    }
    void take(std::vector<wire::RequestContent> requests) {
        for (wire::RequestContent& request : requests) {
            ++requests_;
            asked_bytes_ += request.count;
            const auto found = content_.find(*to_content_hash(request.hash));
            if (found == content_.end()) {
                pieces_.push_back({request.hash, request.offset, 0, {}});
                continue;
            }
            const std::uint64_t size = found->second.size();
            const std::uint64_t end = std::min(size, request.offset + request.count);
            for (std::uint64_t at = request.offset; at < end; at += wire::max_content_piece) {
                const auto begin = found->second.begin() + std::ptrdiff_t(at);
                pieces_.push_back({request.hash, at, size,
                                   Bytes(begin, begin + std::ptrdiff_t(std::min<std::uint64_t>(
                                                            wire::max_content_piece, end - at)))});
            }
        }
    }
    std::optional<wire::Content> next() {
        if (pieces_.empty())
            return std::nullopt;
        wire::Content piece = std::move(pieces_.front());
        pieces_.erase(pieces_.begin());
        return piece;
    }
    void forget() { pieces_.clear(); }
    bool has_answers() const { return !pieces_.empty(); }
    int requests() const { return requests_; }
    std::uint64_t asked_bytes() const { return asked_bytes_; }

private:
    std::map<ContentHash, Bytes> content_;
    std::vector<wire::Content> pieces_;
    int requests_ = 0;
    std::uint64_t asked_bytes_ = 0;
};

class Fetching : public testing::Test {
protected:
    // Exchanges messages until nothing is asked and nothing comes.
    std::vector<ContentFetch::Complete> run(int most_pieces = 1 << 30) {
        std::vector<ContentFetch::Complete> all;
        host_.take(fetch_.take_requests(now_));
        for (int i = 0; i < most_pieces; ++i) {
            const auto piece = host_.next();
            if (!piece)
                break;
            now_ += 1ms;
            if (auto complete = fetch_.on_content(*piece, now_))
                all.push_back(std::move(*complete));
            host_.take(fetch_.take_requests(now_));
        }
        return all;
    }

    TimePoint now_ = from_us(1'000'000);
    SmallHost host_;
    ContentFetch fetch_{make_digest};
};

TEST_F(Fetching, TakesAllThatIsWantedInOrderAndEachByteOnce) {
    const Bytes first = content_of(100'000, 1), second = content_of(5'000'000, 2),
                third = content_of(1, 3);
    std::vector<Wanted> wanted;
    for (const Bytes* bytes : {&first, &second, &third})
        wanted.push_back({host_.add(*bytes), bytes->size(), true});
    fetch_.want(wanted);
    const auto all = run();
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[0].bytes, first);
    EXPECT_EQ(all[1].bytes, second);
    EXPECT_EQ(all[2].bytes, third);
    EXPECT_EQ(host_.asked_bytes(), first.size() + second.size() + third.size());
    EXPECT_EQ(fetch_.progress().got, fetch_.progress().all);
    EXPECT_TRUE(fetch_.take_requests(now_ + 1h).empty());
}

TEST_F(Fetching, GoesOnAfterALostConnectionWhereItWas) {
    const Bytes bytes = content_of(3'000'000, 4);
    fetch_.want({{host_.add(bytes), bytes.size(), true}});
    EXPECT_TRUE(run(70).empty());
    const std::uint64_t got = fetch_.progress().got;
    EXPECT_EQ(got, 70 * wire::max_content_piece);
    host_.forget();
    fetch_.on_connected();
    const std::uint64_t asked = host_.asked_bytes();
    const auto all = run();
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].bytes, bytes);
    EXPECT_EQ(host_.asked_bytes() - asked, bytes.size() - got);
}

TEST_F(Fetching, AsksAgainWhereNoAnswerComes) {
    const Bytes bytes = content_of(1000, 5);
    fetch_.want({{host_.add(bytes), bytes.size(), true}});
    host_.take(fetch_.take_requests(now_));
    host_.forget();
    EXPECT_TRUE(fetch_.take_requests(now_ + 4s).empty());
    now_ += 6s;
    EXPECT_EQ(run().size(), 1u);
    EXPECT_EQ(host_.requests(), 2);
}

TEST_F(Fetching, AtMostTwoRequestsAreUnderWay) {
    const Bytes bytes = content_of(9'000'000, 6);
    fetch_.want({{host_.add(bytes), bytes.size(), true}});
    const auto requests = fetch_.take_requests(now_);
    EXPECT_EQ(requests.size(), 2u);
    EXPECT_TRUE(fetch_.take_requests(now_).empty());
}

TEST_F(Fetching, ContentOfUnknownSizeHasABound) {
    const Bytes small = content_of(500, 7), large = content_of(70'000, 8);
    const ContentHash of_small = host_.add(small), of_large = host_.add(large);
    fetch_.want({{of_large, 65'000, false}, {of_small, 65'000, false}});
    const auto all = run();
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].bytes, small);
    EXPECT_EQ(fetch_.failures().at(of_large), Failure::wrong_size);
}

TEST_F(Fetching, OtherBytesThanAnnouncedAreDiscardedAndNotAskedForAgain) {
    const Bytes bytes = content_of(40'000, 9);
    const ContentHash hash = host_.add(bytes);
    fetch_.want({{hash, bytes.size(), true}});
    host_.take(fetch_.take_requests(now_));
    while (auto piece = host_.next()) {
        piece->bytes.back() ^= std::byte(1);
        EXPECT_FALSE(fetch_.on_content(*piece, now_));
    }
    EXPECT_EQ(fetch_.failures().at(hash), Failure::wrong_bytes);
    EXPECT_TRUE(fetch_.take_requests(now_ + 1h).empty());
    // Another connection, perhaps to a host that was repaired.
    fetch_.on_connected();
    EXPECT_EQ(run().size(), 1u);
    EXPECT_TRUE(fetch_.failures().empty());
}

TEST_F(Fetching, AnAbsurdSizeTakesNoMemory) {
    const ContentHash hash = hash_of(content_of(10, 10));
    fetch_.want({{hash, 100, true}});
    (void)fetch_.take_requests(now_);
    const Bytes name(hash.bytes.begin(), hash.bytes.end());
    EXPECT_FALSE(fetch_.on_content({name, 0, std::uint64_t(1) << 60, Bytes(16)}, now_));
    EXPECT_EQ(fetch_.failures().at(hash), Failure::wrong_size);

    fetch_.on_connected();
    (void)fetch_.take_requests(now_);
    EXPECT_FALSE(fetch_.on_content({name, 0, 100, Bytes(101)}, now_));
    EXPECT_EQ(fetch_.failures().at(hash), Failure::wrong_size);
    EXPECT_EQ(fetch_.progress().got, 0u);
}

TEST_F(Fetching, WhatTheHostDoesNotHaveStopsNothingElse) {
    const Bytes bytes = content_of(1000, 11);
    const ContentHash missing = hash_of(content_of(7, 12));
    fetch_.want({{missing, 7, true}, {host_.add(bytes), bytes.size(), true}});
    EXPECT_EQ(run().size(), 1u);
    EXPECT_EQ(fetch_.failures().at(missing), Failure::not_there);
    host_.add(content_of(7, 12));
    fetch_.retry();
    EXPECT_EQ(run().size(), 1u);
}

TEST_F(Fetching, PiecesThatComeTwiceOrOfOtherContentChangeNothing) {
    const Bytes bytes = content_of(50'000, 13);
    fetch_.want({{host_.add(bytes), bytes.size(), true}});
    host_.take(fetch_.take_requests(now_));
    const auto first = host_.next();
    ASSERT_TRUE(first);
    EXPECT_FALSE(fetch_.on_content(*first, now_));
    EXPECT_FALSE(fetch_.on_content(*first, now_));
    EXPECT_FALSE(fetch_.on_content({Bytes(32), 0, 50'000, Bytes(10)}, now_));
    EXPECT_FALSE(fetch_.on_content({{}, 0, 50'000, Bytes(10)}, now_));
    const auto all = run();
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].bytes, bytes);
}

TEST_F(Fetching, AnotherCaseReplacesWhatIsUnderWay) {
    const Bytes old = content_of(4'000'000, 14), next = content_of(1000, 15);
    fetch_.want({{host_.add(old), old.size(), true}});
    EXPECT_TRUE(run(10).empty());
    fetch_.want({{host_.add(next), next.size(), true}});
    const auto all = run();
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].bytes, next);
}

}  // namespace
}  // namespace theatron::session
