// SPDX-License-Identifier: Apache-2.0
#include "capture/rtsp_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace theatron::capture {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(RtspText, ReadsAUrlWithoutShowingItsPassword) {
    const auto url = parse_rtsp_url("rtsp://cart:p%40ss:word@tower.local:8554/live?a=b");
    ASSERT_TRUE(url);
    EXPECT_EQ(url->host, "tower.local");
    EXPECT_EQ(url->port, 8554);
    EXPECT_EQ(url->user, "cart");
    EXPECT_EQ(url->password, "p@ss:word");
    EXPECT_EQ(url->address, "rtsp://tower.local:8554/live?a=b");
    EXPECT_EQ(parse_rtsp_url("rtsp://[::1]/x")->host, "::1");
    EXPECT_EQ(parse_rtsp_url("rtsp://h")->port, 554);
}

TEST(RtspText, RefusesOtherUrls) {
    for (const char* text : {"", "rtsp://", "http://h/", "rtsp:///x", "rtsp://h:0/", "rtsp://h:x/",
                             "rtsp://h/a b", "rtsp://h/\r\nTEARDOWN", "rtsp://a%zz@h/"})
        EXPECT_FALSE(parse_rtsp_url(text)) << text;
    EXPECT_FALSE(parse_rtsp_url("rtsp://h/" + std::string(max_rtsp_url, 'a')));
}

TEST(RtspText, ReadsAResponse) {
    const auto response = parse_rtsp_response(
        "RTSP/1.0 200 OK\r\nCSeq: 2\r\ncontent-length: 12\r\nSession: abc;timeout=30\r\n"
        "Transport: RTP/AVP/TCP;unicast;interleaved=4-5\r\nContent-Base: rtsp://h/x/\r\n\r\n");
    ASSERT_TRUE(response);
    EXPECT_EQ(response->status, 200);
    EXPECT_EQ(response->body_bytes, 12u);
    EXPECT_EQ(response->session, "abc");
    EXPECT_EQ(response->session_timeout_s, 30);
    EXPECT_EQ(response->channel, 4);
    EXPECT_EQ(response->base, "rtsp://h/x/");
}

TEST(RtspText, ReadsWhereAServerHasMoved) {
    const auto response =
        parse_rtsp_response("RTSP/1.0 302 Found\r\nCSeq: 7\r\nLocation: rtsp://h:55/x\r\n\r\n");
    ASSERT_TRUE(response);
    EXPECT_EQ(response->sequence, 7);
    EXPECT_EQ(response->location, "rtsp://h:55/x");
    EXPECT_FALSE(parse_rtsp_response("RTSP/1.0 302 Found\r\nLocation: rtsp://h/\1\r\n\r\n"));
    EXPECT_FALSE(parse_rtsp_response("RTSP/1.0 302 Found\r\nLocation: rtsp://h/" +
                                     std::string(max_rtsp_url, 'a') + "\r\n\r\n"));
}

TEST(RtspText, AnswersRequestsOfTheServer) {
    const auto answer = answer_to_rtsp_request("OPTIONS rtsp://h/ RTSP/1.0\r\nCSeq: 12\r\n\r\n");
    EXPECT_THAT(answer, HasSubstr("RTSP/1.0 200 OK\r\nCSeq: 12\r\n"));
    for (const char* method : {"SET_PARAMETER", "GET_PARAMETER"})
        EXPECT_NE(answer_to_rtsp_request(std::string(method) + " * RTSP/1.0\r\ncseq: 1\r\n\r\n"),
                  "");
    for (const char* none :
         {"", "OPTIONS", "OPTIONS * HTTP/1.1\r\nCSeq: 1\r\n\r\n", "OPTIONS * RTSP/1.0\r\n\r\n",
          "OPTIONS * RTSP/1.0\r\nCSeq: x\r\n\r\n", "two words RTSP/1.0\r\nCSeq: 1\r\n\r\n"})
        EXPECT_EQ(answer_to_rtsp_request(none), "") << none;
    for (const char* method : {"ANNOUNCE", "TEARDOWN", "PLAY_NOTIFY"})
        EXPECT_THAT(answer_to_rtsp_request(std::string(method) + " * RTSP/1.0\r\nCSeq: 7\r\n\r\n"),
                    HasSubstr("RTSP/1.0 501 Not Implemented\r\nCSeq: 7\r\n"));
}

TEST(RtspText, AHeadEndsWithAnEmptyLineOfEitherKind) {
    EXPECT_EQ(rtsp_head_bytes("RTSP/1.0 200 OK\r\nCSeq: 1\r\n\r\nv=0"), 28u);
    EXPECT_EQ(rtsp_head_bytes("RTSP/1.0 200 OK\nCSeq: 1\n\nv=0"), 25u);
    for (const char* open : {"", "\n", "RTSP/1.0 200 OK\r\nCSeq: 1\r\n", "a\r\n\r"})
        EXPECT_EQ(rtsp_head_bytes(open), std::string_view::npos) << open;
}

TEST(RtspText, TakesTheStrongestChallengeThatItKnows) {
    const std::string
        sha = "WWW-Authenticate: Digest realm=\"r\", nonce=\"n\", algorithm=SHA-256\r\n",
        md5 = "WWW-Authenticate: Digest realm=\"r\", nonce=\"m\"\r\n",
        basic = "WWW-Authenticate: Basic realm=\"r\"\r\n";
    const auto taken = [](const std::string& headers) {
        return parse_rtsp_response("RTSP/1.0 401 Unauthorized\r\n" + headers + "\r\n")->challenge;
    };
    for (const std::string& headers : {sha + md5, md5 + sha, basic + md5 + sha, md5 + basic})
        EXPECT_EQ(taken(headers), "Digest realm=\"r\", nonce=\"m\"") << headers;
    for (const std::string& headers : {sha + basic, basic + sha})
        EXPECT_EQ(taken(headers), "Basic realm=\"r\"") << headers;
}

TEST(RtspText, TellsATransportThatIsNotThisConnection) {
    const auto over_udp = [](const std::string& transport) {
        return parse_rtsp_response("RTSP/1.0 200 OK\r\nTransport: " + transport + "\r\n\r\n")
            ->is_over_udp;
    };
    EXPECT_TRUE(over_udp("RTP/AVP;unicast;client_port=5000-5001"));
    EXPECT_TRUE(over_udp("RTP/AVP/UDP;unicast"));
    EXPECT_FALSE(over_udp("RTP/AVP/TCP;unicast;interleaved=0-1"));
    EXPECT_FALSE(over_udp("RTP/AVP/TCP;unicast"));
    EXPECT_FALSE(over_udp("RTP/AVP;interleaved=0-1"));
}

TEST(RtspText, AServerMayMoveToAPathAlone) {
    EXPECT_EQ(moved_rtsp_address("rtsp://h:5/a/b?c=/d", "/x"), "rtsp://h:5/x");
    EXPECT_EQ(moved_rtsp_address("rtsp://h:5/a/b?c=/d", "x"), "rtsp://h:5/a/x");
    EXPECT_EQ(moved_rtsp_address("rtsp://h", "x"), "rtsp://h/x");
    EXPECT_EQ(moved_rtsp_address("rtsp://h/a", "rtsp://i/x"), "rtsp://i/x");
}

TEST(RtspText, RefusesWhatIsNoResponseOrTooLong) {
    EXPECT_FALSE(parse_rtsp_response("HTTP/1.1 200 OK\r\n\r\n"));
    EXPECT_FALSE(parse_rtsp_response("RTSP/1.0 abc\r\n\r\n"));
    EXPECT_FALSE(parse_rtsp_response(""));
    EXPECT_FALSE(parse_rtsp_response("RTSP/1.0 200 OK\r\nContent-Length: 1000000000\r\n\r\n"));
    EXPECT_FALSE(parse_rtsp_response("RTSP/1.0 200 OK\r\nContent-Length: -1\r\n\r\n"));
    EXPECT_FALSE(parse_rtsp_response("RTSP/1.0 200 OK\r\nX: " + std::string(max_rtsp_head, 'a')));
}

TEST(RtspText, TakesTheFirstVideoTrackAndNothingElseOfADescription) {
    const auto track = find_rtsp_track(
        "v=0\r\nc=IN IP4 10.0.0.1\r\na=control:*\r\nm=audio 0 RTP/AVP 0\r\na=control:a\r\n"
        "m=video 5000 RTP/AVP 97\r\nc=IN IP4 evil.example\r\na=rtpmap:97 H264/90000\r\n"
        "a=fmtp:97 packetization-mode=1\r\na=control:track2\r\na=x:y\r\nm=video 0 RTP/AVP 98\r\n",
        "rtsp://h/x/");
    ASSERT_TRUE(track);
    EXPECT_EQ(track->control, "rtsp://h/x/track2");
    EXPECT_EQ(track->aggregate, "rtsp://h/x/");
    EXPECT_THAT(track->description,
                HasSubstr("m=video 0 RTP/AVP 97\r\na=rtpmap:97 H264/90000\r\n"));
    EXPECT_THAT(track->description, HasSubstr("a=fmtp:97 "));
    for (const char* other : {"evil", "10.0.0.1", "audio", "98", "a=x"})
        EXPECT_THAT(track->description, Not(HasSubstr(other)));
    EXPECT_EQ(find_rtsp_track("a=control:rtsp://h/all/\r\nm=video 0 RTP/AVP 9\r\na=control:1\r\n"
                              "a=rtpmap:9 h264/90000/1\r\n",
                              "rtsp://h/")
                  ->aggregate,
              "rtsp://h/all/");
    EXPECT_FALSE(find_rtsp_track("v=0\r\nm=audio 0 RTP/AVP 0\r\n", "rtsp://h/"));
    EXPECT_FALSE(
        find_rtsp_track("m=video 0 RTP/AVP 96\r\na=rtpmap:96 X-ODD/90000\r\n", "rtsp://h/"));
}

// The example of RFC 2617, section 3.5, has qop and a nonce of the client; this one is computed
// without them: MD5(MD5("u:r:p") ":n:" MD5("DESCRIBE:rtsp://h/")).
TEST(RtspText, AnswersChallenges) {
    const RtspUrl url{"h", 554, "u", "p", "rtsp://h/"};
    EXPECT_EQ(rtsp_authorization(url, "Basic realm=\"r\"", "DESCRIBE", "rtsp://h/"), "Basic dTpw");
    EXPECT_THAT(rtsp_authorization(url, "Digest realm=\"r\", nonce=\"n\"", "DESCRIBE", "rtsp://h/"),
                HasSubstr("response=\"6231f339632dca5d8dc9df283162399c\""));
    EXPECT_EQ(rtsp_authorization(url, "Digest realm=\"r\", nonce=\"n\", algorithm=SHA-256",
                                 "DESCRIBE", "rtsp://h/"),
              "");
    EXPECT_THAT(rtsp_authorization(url, "Digest realm=\"r\", nonce=\"n\", qop=\"auth\"", "PLAY",
                                   "rtsp://h/", 26),
                HasSubstr("qop=auth, nc=0000001a, "));
    EXPECT_EQ(rtsp_authorization(url, "Negotiate", "DESCRIBE", "rtsp://h/"), "");
}

}  // namespace
}  // namespace theatron::capture
