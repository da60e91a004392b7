// SPDX-License-Identifier: Apache-2.0
#include "codec/depth_stream.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "codec/test_images.h"

namespace theatron::codec {
namespace {

constexpr Size size{40, 24};

struct Sent {
    EncodedDepth link;
    Bytes bytes;
    DepthImage depth;
};

DepthSetting setting(const std::string& text) {
    return parse_depth_setting(text).setting;
}

// Encodes `count` frames, numbered from 100. Key frames are requested for those in
// `keys`.
std::vector<Sent> stream(const std::string& text, unsigned count,
                         const std::set<unsigned>& keys = {}) {
    DepthStreamEncoder encoder(setting(text));
    std::vector<Sent> sent;
    for (unsigned i = 0; i < count; ++i) {
        Sent frame;
        frame.depth = scene(size, i);
        frame.bytes.resize(encoder.max_encoded_size(size));
        frame.link = encoder.encode(frame.depth.view(), 100 + i, keys.contains(i), frame.bytes);
        frame.bytes.resize(frame.link.bytes);
        sent.push_back(std::move(frame));
    }
    return sent;
}

// Decodes the frames selected by `arrives`, checks their depth, and returns the
// statuses.
std::vector<Status> receive(const std::string& text, const std::vector<Sent>& sent,
                            const std::function<bool(unsigned, const Sent&)>& arrives) {
    DepthStreamDecoder decoder(setting(text));
    std::vector<Status> statuses;
    for (unsigned i = 0; i < sent.size(); ++i) {
        if (!arrives(i, sent[i]))
            continue;
        DepthImage out(size);
        const Status status = decoder.decode(sent[i].link, sent[i].bytes, out.view());
        if (status == Status::ok) {
            EXPECT_EQ(out, sent[i].depth) << "frame " << i;
        }
        statuses.push_back(status);
    }
    return statuses;
}

bool all_ok(const std::vector<Status>& statuses) {
    return std::all_of(statuses.begin(), statuses.end(), [](Status s) { return s == Status::ok; });
}

const auto everything = [](unsigned, const Sent&) { return true; };

TEST(DepthStream, LayersFormAHierarchy) {
    std::vector<int> layers, references;
    for (const Sent& frame : stream("trvl:layers=3", 10)) {
        layers.push_back(frame.link.layer);
        references.push_back(int(frame.link.reference_frame) - 100);
    }
    EXPECT_EQ(layers, (std::vector<int>{0, 2, 1, 2, 0, 2, 1, 2, 0, 2}));
    EXPECT_EQ(references, (std::vector<int>{0, 0, 0, 2, 0, 4, 4, 6, 4, 8}));
}

TEST(DepthStream, TwoLayersAlternate) {
    std::vector<int> references;
    for (const Sent& frame : stream("trvl:layers=2", 6))
        references.push_back(int(frame.link.reference_frame) - 100);
    EXPECT_EQ(references, (std::vector<int>{0, 0, 0, 2, 2, 4}));
}

TEST(DepthStream, DecodesWithAnyNumberOfLayers) {
    for (const char* text : {"raw", "rvl", "trvl", "trvl:layers=2", "trvl:layers=3", "zstd:delta=1",
                             "zstd:delta=1,layers=3", "strata", "strata:layers=3"}) {
        const auto sent = stream(text, 20);
        EXPECT_TRUE(all_ok(receive(text, sent, everything))) << text;
    }
}

TEST(DepthStream, EveryFrameOfACodecWithoutReferencesIsAKey) {
    for (const Sent& frame : stream("rvl", 3)) {
        EXPECT_TRUE(frame.link.key);
        EXPECT_EQ(frame.link.layer, 0);
        EXPECT_EQ(frame.link.reference_frame, frame.link.frame);
    }
}

TEST(DepthStream, HigherLayersCanBeLeftOut) {
    const auto sent = stream("trvl:layers=3", 21);
    for (int highest = 0; highest < 3; ++highest) {
        const auto statuses = receive("trvl:layers=3", sent, [&](unsigned, const Sent& frame) {
            return frame.link.layer <= highest;
        });
        EXPECT_TRUE(all_ok(statuses));
        EXPECT_EQ(statuses.size(), highest == 0 ? 6u : highest == 1 ? 11u : 21u);
    }
}

TEST(DepthStream, LayersCanChangeWhileReceiving) {
    const auto sent = stream("trvl:layers=3", 60);
    EXPECT_TRUE(all_ok(receive("trvl:layers=3", sent, [](unsigned i, const Sent& frame) {
        return frame.link.layer <= int(i / 8) % 3;
    })));
}

TEST(DepthStream, ASkippedFrameCostsOnlyThoseThatReferToIt) {
    const auto sent = stream("trvl:layers=3", 12);
    // Frame 6 is of layer 1; only frame 7 refers to it.
    const auto statuses =
        receive("trvl:layers=3", sent, [](unsigned i, const Sent&) { return i != 6; });
    std::vector<Status> expected(11, Status::ok);
    expected[6] = Status::missing_reference;
    EXPECT_EQ(statuses, expected);
}

TEST(DepthStream, AfterALostBaseFrameOnlyAKeyHelps) {
    const auto sent = stream("trvl", 10, {7});
    const auto statuses = receive("trvl", sent, [](unsigned i, const Sent&) { return i != 3; });
    for (std::size_t i = 0; i < statuses.size(); ++i)
        EXPECT_EQ(statuses[i], i < 3 || i >= 6 ? Status::ok : Status::missing_reference) << i;
}

TEST(DepthStream, AReceiverJoinsAtAKeyFrame) {
    const auto sent = stream("trvl:layers=3", 20, {9});
    EXPECT_EQ(sent[9].link.layer, 0);
    EXPECT_EQ(sent[10].link.layer, 2);
    EXPECT_TRUE(
        all_ok(receive("trvl:layers=3", sent, [](unsigned i, const Sent&) { return i >= 9; })));
}

TEST(DepthStream, AKeyFrameEndsWhatWasBefore) {
    const auto sent = stream("trvl:layers=3", 8, {7});
    DepthStreamDecoder decoder(setting("trvl:layers=3"));
    DepthImage out(size);
    for (const unsigned i : {0u, 2u, 4u, 7u})
        ASSERT_EQ(decoder.decode(sent[i].link, sent[i].bytes, out.view()), Status::ok);
    // Frame 3 refers to frame 2, which was stored until the key frame.
    EXPECT_EQ(decoder.decode(sent[3].link, sent[3].bytes, out.view()), Status::missing_reference);
}

// A late joiner receives the last key frame and the layer-0 frames since.
TEST(DepthStream, AReceiverJoinsWithTheKeyAndTheBaseLayerSince) {
    const auto sent = stream("trvl:layers=3", 40, {10});
    EXPECT_TRUE(all_ok(receive("trvl:layers=3", sent, [](unsigned i, const Sent& frame) {
        return i >= 10 && (i >= 30 || frame.link.layer == 0);
    })));
}

TEST(DepthStream, ASkippedFrameBeforeTheEncoderChangesNothing) {
    DepthStreamEncoder encoder(setting("trvl:layers=2"));
    DepthStreamDecoder decoder(setting("trvl:layers=2"));
    Bytes out(encoder.max_encoded_size(size));
    DepthImage decoded(size);
    for (const unsigned number : {5u, 6u, 9u, 10u, 30u}) {
        const DepthImage depth = scene(size, number);
        const EncodedDepth link = encoder.encode(depth.view(), number, false, out);
        ASSERT_EQ(decoder.decode(link, ByteView(out).first(link.bytes), decoded.view()),
                  Status::ok);
        EXPECT_EQ(decoded, depth);
    }
}

TEST(DepthStream, ANewImageSizeStartsWithAKey) {
    DepthStreamEncoder encoder(setting("trvl"));
    Bytes out(encoder.max_encoded_size(size));
    EXPECT_TRUE(encoder.encode(scene(size, 0).view(), 0, false, out).key);
    EXPECT_FALSE(encoder.encode(scene(size, 1).view(), 1, false, out).key);
    EXPECT_TRUE(encoder.encode(scene({24, 40}, 2).view(), 2, false, out).key);
    EXPECT_FALSE(encoder.encode(scene({24, 40}, 3).view(), 3, false, out).key);
}

TEST(DepthStream, RefusesLinksThatCannotBe) {
    const auto sent = stream("trvl:layers=2", 4);
    DepthStreamDecoder decoder(setting("trvl:layers=2"));
    DepthImage out(size);
    ASSERT_EQ(decoder.decode(sent[0].link, sent[0].bytes, out.view()), Status::ok);
    const auto status_of = [&](FrameLink link) {
        return decoder.decode(link, sent[1].bytes, out.view());
    };
    EXPECT_EQ(status_of({101, 100, 2, false}), Status::malformed) << "a layer too many";
    EXPECT_EQ(status_of({101, 100, -1, false}), Status::malformed);
    EXPECT_EQ(status_of({101, 101, 1, true}), Status::malformed) << "a key off the base";
    EXPECT_EQ(status_of({101, 99, 1, false}), Status::missing_reference);
    EXPECT_EQ(status_of({101, 101, 0, true}), Status::missing_reference) << "no key after all";
    // The hostile input left the decoder intact.
    EXPECT_EQ(decoder.decode(sent[1].link, sent[1].bytes, out.view()), Status::ok);
    EXPECT_EQ(out, sent[1].depth);
}

TEST(DepthStream, DamagedFramesLeaveTheReferencesAlone) {
    const auto sent = stream("trvl", 4);
    DepthStreamDecoder decoder(setting("trvl"));
    DepthImage out(size);
    for (const Sent& frame : sent) {
        const ByteView half = ByteView(frame.bytes).first(frame.bytes.size() / 2);
        EXPECT_NE(decoder.decode(frame.link, half, out.view()), Status::ok);
        ASSERT_EQ(decoder.decode(frame.link, frame.bytes, out.view()), Status::ok);
        EXPECT_EQ(out, frame.depth);
    }
}

}  // namespace
}  // namespace theatron::codec
