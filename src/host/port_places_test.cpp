// SPDX-License-Identifier: Apache-2.0
#include "host/port_places.h"

#include <gtest/gtest.h>

#include <numeric>

#include "host/session_folder.h"

namespace theatron::host {
namespace {

using Kind = PortPlaces::Kind;

constexpr std::size_t kept_for_one =
    std::accumulate(PortPlaces::kept_for.begin(), PortPlaces::kept_for.end(), std::size_t(0));

// Places with as many sessions.
class Port {
public:
    explicit Port(int sessions) {
        for (int i = 1; i <= sessions; ++i)
            places.add(SessionNumber(i));
    }
    bool enter(int session, Kind kind) {
        if (!places.has_place(SessionNumber(session), kind))
            return false;
        places.enter(net::PeerId{next++}, SessionNumber(session), kind);
        return true;
    }
    int fill(int session, Kind kind) {
        int came = 0;
        while (enter(session, kind))
            ++came;
        return came;
    }
    PortPlaces places;
    std::uint32_t next = 1;
};

TEST(PortPlaces, KeepsPlacesForEachSessionItsOperatorsAndThoseWhoComeBack) {
    Port port(3);
    for (const Kind kind : {Kind::other, Kind::viewer_again, Kind::recorder_again})
        port.fill(1, kind);
    EXPECT_FALSE(port.enter(1, Kind::other));
    EXPECT_EQ(port.fill(1, Kind::operator_), int(PortPlaces::kept_for[0]));
    for (const int session : {2, 3})
        for (std::size_t kind = 0; kind < PortPlaces::kinds; ++kind)
            EXPECT_EQ(port.fill(session, Kind(kind)), int(PortPlaces::kept_for[kind]));
    EXPECT_EQ(port.next - 1, PortPlaces::most);
}

TEST(PortPlaces, OneSessionAloneHasNearlyAllAndAPlaceIsFreeAgain) {
    Port port(1);
    const int others = port.fill(1, Kind::other);
    EXPECT_EQ(std::size_t(others), PortPlaces::most - kept_for_one + PortPlaces::kept_for[3]);
    port.places.leave(net::PeerId{5});
    port.places.leave(net::PeerId{5});
    EXPECT_EQ(port.fill(1, Kind::other), 1);
}

TEST(PortPlaces, AllSessionsHaveTheirShare) {
    EXPECT_LE(max_sessions * kept_for_one, PortPlaces::most);
    Port port{int(max_sessions)};
    for (int session = 1; session <= int(max_sessions); ++session)
        for (std::size_t kind = 0; kind < PortPlaces::kinds; ++kind)
            for (std::size_t i = 0; i < PortPlaces::kept_for[kind]; ++i)
                EXPECT_TRUE(port.enter(session, Kind(kind))) << session;
}

TEST(PortPlaces, ASessionThatBeginsInAFullPortGetsTheNextPlaces) {
    Port port(1);
    for (std::size_t kind = PortPlaces::kinds; kind-- > 0;)
        port.fill(1, Kind(kind));
    port.places.add(SessionNumber{2});
    EXPECT_FALSE(port.enter(2, Kind::operator_));
    port.places.leave(net::PeerId{1});
    EXPECT_FALSE(port.enter(1, Kind::other));
    EXPECT_TRUE(port.enter(2, Kind::operator_));
    port.places.remove(SessionNumber{1});
    port.places.leave(net::PeerId{2});
    EXPECT_TRUE(port.enter(2, Kind::other));
}

}  // namespace
}  // namespace theatron::host
