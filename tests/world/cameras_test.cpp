// SPDX-License-Identifier: Apache-2.0
// Cameras of people: seen, counted and recorded by the others, while links break and cameras come
// and go.
#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

#include "host/audit_log.h"
#include "world/acts.h"
#include "world/sent_camera.h"

namespace theatron::world {
namespace {

using ::testing::ElementsAre;
using Phase = client::Participant::Phase;

// The pictures that a person has seen, by their numbers.
class Seen {
public:
    explicit Seen(Person& person) {
        person.options.depth_codec = "zstd";
        person.options.news = [this, &person] {
            if (!person.is_here())
                return;
            for (const auto& frame : person->take_frames())
                if (frame->camera == camera.value_or(frame->camera))
                    numbers.push_back(SentCamera::number_in(frame->depth.view()));
        };
    }
    std::optional<CameraId> camera;  // this one alone
    bool is_in_order() const { return std::is_sorted(numbers.begin(), numbers.end()); }
    int gaps() const {
        int count = 0;
        for (std::size_t i = 1; i < numbers.size(); ++i)
            count += numbers[i] != numbers[i - 1] + 1;
        return count;
    }
    std::vector<int> numbers;
};

struct Stage {
    World world;
    Person& carl = world.person("Carl");
    SentCamera camera{carl, "table"};
    Person& anna = world.person("Anna");
    Seen seen{anna};

    void begin() {
        (void)world.joined("Carl", wire::Role::publisher);
        camera.start();
        (void)world.joined("Anna");
    }
};

std::vector<client::Participant::Camera> cameras(Person& person) {
    std::uint64_t generation = 0;
    return person->cameras(generation);
}

// More wishes than the host takes at once: it keeps the last one for later.
TEST(WorldCameras, TheLastOfManyWishesHolds) {
    Stage stage;
    stage.begin();
    ASSERT_TRUE(stage.world.until([&] { return !stage.seen.numbers.empty(); }));
    for (int i = 0; i < 100; ++i) {
        stage.anna->choose_codecs(i % 2 == 0 ? "rvl" : "lz4", "");
        stage.world.advance(5ms);
    }
    stage.anna->choose_codecs("raw", "");
    EXPECT_TRUE(stage.world.until(
        [&] { return stage.camera.codecs() == std::vector<std::string>{"raw"}; }));
    stage.world.advance(10s);
    EXPECT_THAT(stage.camera.codecs(), ElementsAre("raw"));
}

// Time alone brings it there: no message follows the last change.
TEST(WorldCameras, AnAdjustmentThatRestsIsInTheAuditLog) {
    Stage stage;
    stage.begin();
    Person& olga = stage.world.joined("Olga", wire::Role::operator_);
    ASSERT_TRUE(stage.world.until([&] { return !cameras(olga).empty(); }));
    session::CameraAdjustment adjustment;
    for (const double moved_m : {0.01, 0.02, 0.03}) {
        adjustment.moved_m = {moved_m, 0, 0};
        (void)olga->adjust(cameras(olga).front().description.id, adjustment);
        stage.world.advance(100ms);
    }
    stage.world.advance(4s);
    stage.world.end_host();
    std::ifstream file(host::usual_audit_log(stage.world.folder() / "state"));
    const std::string log{std::istreambuf_iterator<char>(file), {}};
    EXPECT_THAT(log, ::testing::HasSubstr("moved by 30.0, 0.0, 0.0 mm"));
    EXPECT_THAT(log, ::testing::Not(::testing::HasSubstr("moved by 10.0")));
}

TEST(WorldCameras, EachPictureIsSeenOnceAndInOrder) {
    Stage stage;
    stage.begin();
    stage.world.advance(20s);
    ASSERT_EQ(cameras(stage.anna).size(), 1u);
    EXPECT_EQ(cameras(stage.anna).front().description.name, "table");
    EXPECT_GT(stage.seen.numbers.size(), 180u);
    EXPECT_EQ(stage.seen.gaps(), 0);
    EXPECT_EQ(stage.world.host().figures().published.size(), 1u);
}

TEST(WorldCameras, ACameraThatEndsIsGoneAndComesBack) {
    Stage stage;
    stage.begin();
    stage.world.advance(5s);
    stage.camera.stop();
    EXPECT_TRUE(stage.world.until([&] { return cameras(stage.anna).empty(); }));
    EXPECT_TRUE(stage.world.until([&] { return stage.world.host().figures().published.empty(); }));
    const auto before = stage.seen.numbers.size();
    stage.world.advance(2s);
    EXPECT_EQ(stage.seen.numbers.size(), before);
    stage.camera.start();
    stage.world.advance(5s);
    EXPECT_GT(stage.seen.numbers.size(), before + 40);
    EXPECT_TRUE(stage.seen.is_in_order());
    stage.carl.leave();
    EXPECT_TRUE(stage.world.until([&] { return cameras(stage.anna).empty(); }));
}

TEST(WorldCameras, CamerasThatComeAndGoCostTheOthersNoPicture) {
    Stage stage;
    Person& dora = stage.world.person("Dora");
    SentCamera other(dora, "hand");
    stage.begin();
    ASSERT_TRUE(stage.world.until([&] { return !stage.seen.numbers.empty(); }));
    stage.seen.camera = cameras(stage.anna).front().description.id;
    (void)stage.world.joined("Dora", wire::Role::publisher);
    other.start();
    EXPECT_TRUE(stage.world.until([&] { return cameras(stage.anna).size() == 2; }));
    stage.world.advance(3s);
    other.stop();
    EXPECT_TRUE(stage.world.until([&] { return cameras(stage.anna).size() == 1; }));
    other.start();
    EXPECT_TRUE(stage.world.until([&] { return cameras(stage.anna).size() == 2; }));
    dora.path().reset();
    EXPECT_TRUE(stage.world.until([&] { return cameras(stage.anna).size() == 1; }));
    EXPECT_TRUE(stage.world.until([&] { return cameras(stage.anna).size() == 2; }));
    dora.leave();
    EXPECT_TRUE(stage.world.until([&] { return cameras(stage.anna).size() == 1; }));
    stage.world.advance(3s);
    EXPECT_GT(stage.seen.numbers.size(), 60u);
    EXPECT_EQ(stage.seen.gaps(), 0);
}

TEST(WorldCameras, APublisherWhoseLinkBreaksGoesOn) {
    Stage stage;
    stage.begin();
    stage.world.advance(5s);
    stage.carl.path().reset();
    EXPECT_TRUE(stage.world.until([&] { return stage.carl->status().phase == Phase::lost; }));
    EXPECT_FALSE(stage.camera.is_published());
    EXPECT_TRUE(stage.world.until([&] { return cameras(stage.anna).empty(); }));
    const auto before = stage.seen.numbers.size();
    EXPECT_TRUE(stage.world.until([&] { return stage.seen.numbers.size() > before + 50; }));
    EXPECT_TRUE(stage.seen.is_in_order());
    EXPECT_EQ(cameras(stage.anna).size(), 1u);
}

TEST(WorldCameras, ASlowViewerGetsFewerPicturesAndNoOldOnes) {
    Stage stage;
    stage.anna.path().bytes_per_second = 6000;  // of the connections to come
    Person& ben = stage.world.person("Ben");
    Seen fast(ben);
    stage.anna.options.depth_codec = ben.options.depth_codec = "raw";  // 15 kB/s
    stage.begin();
    (void)stage.world.joined("Ben");
    stage.world.advance(30s);
    EXPECT_GT(fast.numbers.size(), 290u);
    EXPECT_EQ(fast.gaps(), 0);
    EXPECT_LT(stage.seen.numbers.size(), 200u);
    EXPECT_GT(stage.seen.numbers.size(), 10u);
    EXPECT_TRUE(stage.seen.is_in_order());
    EXPECT_GT(stage.seen.numbers.back(), fast.numbers.back() - 100);
}

TEST(WorldCameras, WhoLooksBackSeesThePastAndTheOthersDoNot) {
    Stage stage;
    Person& ben = stage.world.person("Ben");
    Seen present(ben);
    stage.begin();
    (void)stage.world.joined("Ben");
    stage.world.advance(20s);
    ASSERT_TRUE(stage.anna->can_look_back());
    EXPECT_NE(stage.anna->look_back(10s), 0u);
    EXPECT_TRUE(stage.world.until([&] { return stage.anna->looks_back(); }));
    stage.world.advance(5s);
    EXPECT_LT(stage.seen.numbers.back(), stage.camera.sent() - 60);
    EXPECT_GT(stage.seen.numbers.back(), stage.camera.sent() - 140);
    EXPECT_GT(present.numbers.back(), stage.camera.sent() - 10);
    EXPECT_EQ(present.gaps(), 0);
    EXPECT_NE(stage.anna->look_back({}), 0u);
    EXPECT_TRUE(stage.world.until([&] { return !stage.anna->looks_back(); }));
    stage.world.advance(5s);
    EXPECT_GT(stage.seen.numbers.back(), stage.camera.sent() - 10);
}

TEST(WorldCameras, ExpertsMayNotPublish) {
    World world;
    Person& anna = world.person("Anna");
    SentCamera camera(anna, "desk");
    (void)world.joined("Anna");
    camera.start();
    EXPECT_TRUE(world.until([&] { return !anna->status().publish_problem.empty(); }));
    EXPECT_TRUE(world.host().figures().published.empty());
}

TEST(WorldCameras, AHostThatIsStoppedLeavesNoPictureWithItsPeople) {
    Stage stage;
    stage.begin();
    stage.world.advance(5s);
    ASSERT_EQ(cameras(stage.anna).size(), 1u);
    stage.world.host().end_for_now();
    stage.world.end_host();
    EXPECT_TRUE(stage.world.until([&] { return stage.anna->status().phase == Phase::lost; }));
    EXPECT_TRUE(cameras(stage.anna).empty());
    EXPECT_TRUE(stage.anna->take_frames().empty());
    (void)stage.world.host();
    EXPECT_TRUE(stage.world.until([&] { return cameras(stage.anna).size() == 1; }));
}

}  // namespace
}  // namespace theatron::world
