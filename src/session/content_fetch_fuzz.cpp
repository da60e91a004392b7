// SPDX-License-Identifier: Apache-2.0
// A host that sends anything in answer to requests: no more memory than what came, no content
// without the right hash, never more under way than allowed.
#include <cstdlib>

#include "session/content_fetch.h"

using namespace theatron;
using session::ContentFetch;

namespace {

// The first bytes and the number of all.
class SmallDigest final : public ContentDigest {
public:
    void add(ByteView piece) override {
        for (const std::byte b : piece) {
            if (count_ < 8)
                hash_.bytes[count_] = b;
            ++count_;
        }
        hash_.bytes[8] = std::byte(count_);
    }
    ContentHash finish() override { return hash_; }

private:
    ContentHash hash_;
    std::size_t count_ = 0;
};

ContentHash name(std::uint8_t choice, std::uint8_t size) {
    ContentHash hash;
    for (std::size_t i = 0; i < 8 && i < size; ++i)
        hash.bytes[i] = std::byte(choice);
    hash.bytes[8] = std::byte(size);
    return hash;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    ByteReader in(std::as_bytes(std::span(data, size)));
    ContentFetch fetch([] { return std::make_unique<SmallDigest>(); });
    TimePoint now = from_us(1'000'000);
    std::uint64_t came = 0;
    while (!in.rest().empty()) {
        const auto what = in.get<std::uint8_t>(), choice = in.get<std::uint8_t>(),
                   length = in.get<std::uint8_t>();
        const ContentHash hash = name(choice % 4, length);
        const Bytes hash_bytes(hash.bytes.begin(), hash.bytes.end());
        now += std::chrono::milliseconds(what);
        switch (what % 6) {
            case 0:
                fetch.want(
                    {{hash, std::uint64_t(length) + 1, choice % 2 == 0}, {name(1, 9), 9, true}});
                break;
            case 1:
                fetch.on_connected();
                break;
            case 2:
                fetch.retry();
                break;
            default: {
                wire::Content piece{hash_bytes, what % 6 == 3 ? 0u : in.get<std::uint8_t>(),
                                    in.get<std::uint8_t>(), Bytes(length, std::byte(choice % 4))};
                came += piece.bytes.size();
                if (const auto complete = fetch.on_content(piece, now)) {
                    SmallDigest digest;
                    digest.add(complete->bytes);
                    if (digest.finish() != complete->hash)
                        std::abort();
                }
            }
        }
        std::uint64_t asked = 0;
        for (const wire::RequestContent& request : fetch.take_requests(now)) {
            asked += request.count;
            if (request.count == 0 || request.count > wire::max_content_request)
                std::abort();
        }
        if (asked > ContentFetch::max_outstanding || fetch.progress().got > came)
            std::abort();
    }
    return 0;
}
