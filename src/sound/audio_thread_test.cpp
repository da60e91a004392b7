// SPDX-License-Identifier: Apache-2.0
#include "sound/audio_thread.h"

#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include "base/error.h"
#include "base/steady_clock.h"

namespace theatron::sound {
namespace {

// A machine whose devices come and go, and whose system may stand still.
struct SystemState {
    std::mutex mutex;
    std::condition_variable changed;
    std::set<std::string> plugged;
    bool stands_still = false;
    std::set<std::thread::id> callers;
    std::vector<std::string> calls;
    std::map<AudioSystem::DeviceId, std::pair<std::string, AudioSystem::Block>> open;

    void set(bool still) {
        const std::lock_guard lock(mutex);
        stands_still = still;
        changed.notify_all();
    }
    void plug(const std::string& name, bool is_plugged) {
        const std::lock_guard lock(mutex);
        if (is_plugged)
            plugged.insert(name);
        else
            plugged.erase(name);
    }
    // As a thread of the system's does it.
    std::vector<float> block() {
        const std::lock_guard lock(mutex);
        std::vector<float> samples(4, 7.0f);
        for (auto& [id, device] : open)
            device.second(samples);
        return samples;
    }
    std::string called() {
        const std::lock_guard lock(mutex);
        std::string text;
        for (const std::string& call : calls)
            text += call + "|";
        return text;
    }
};

class StandInSystem : public AudioSystem {
public:
    explicit StandInSystem(std::shared_ptr<SystemState> machine) : machine_(std::move(machine)) {}
    DeviceId open(const Wanted& wanted, Block block) override {
        const auto lock = note("open " + wanted.name);
        if (!machine_->plugged.contains(wanted.name))
            throw Error("There is no '" + wanted.name + "'.");
        machine_->open[++last_] = {wanted.name, std::move(block)};
        return last_;
    }
    void close(DeviceId device) override {
        const auto lock = note("close " + machine_->open[device].first);
        machine_->open.erase(device);
    }
    bool works(DeviceId device) override {
        const std::lock_guard lock(machine_->mutex);
        machine_->callers.insert(std::this_thread::get_id());
        return machine_->plugged.contains(machine_->open[device].first);
    }
    DeviceList devices() override {
        const auto lock = note("list");
        return {{machine_->plugged.begin(), machine_->plugged.end()}, {}, ""};
    }

private:
    std::unique_lock<std::mutex> note(const std::string& call) {
        std::unique_lock lock(machine_->mutex);
        machine_->callers.insert(std::this_thread::get_id());
        machine_->calls.push_back(call);
        machine_->changed.wait(lock, [this] { return !machine_->stands_still; });
        return lock;
    }
    const std::shared_ptr<SystemState> machine_;
    DeviceId last_ = 0;
};

class Audio : public ::testing::Test {
protected:
    ~Audio() override { machine_->set(false); }
    template <class Condition>
    static bool wait_for(Condition condition) {
        for (int i = 0; i < 20'000 && !condition(); ++i)
            std::this_thread::sleep_for(1ms);
        return condition();
    }
    const std::shared_ptr<SystemState> machine_ = std::make_shared<SystemState>();
    AudioThread audio_{std::make_unique<StandInSystem>(machine_)};
    const AudioSystem::Block fill_ = [](std::span<float> out) {
        std::fill(out.begin(), out.end(), 1.0f);
    };
};

TEST_F(Audio, OneThreadOpensClosesAndAsks) {
    machine_->plug("desk", true);
    auto opens = [&] {
        for (int i = 0; i < 20; ++i) {
            const auto device = audio_.open({"desk", false, 1}, fill_);
            audio_.ask([](const DeviceList&) {});
        }
    };
    std::thread first(opens), second(opens);
    first.join();
    second.join();
    EXPECT_TRUE(audio_.wait_until_idle(20s));
    const std::lock_guard lock(machine_->mutex);
    EXPECT_EQ(machine_->callers.size(), 1u);
    EXPECT_TRUE(machine_->open.empty());
    EXPECT_FALSE(machine_->callers.contains(std::this_thread::get_id()));
}

TEST_F(Audio, ADeviceComesGoesAndSaysWhyItCannotBeUsed) {
    auto device = audio_.open({"desk", true, 1}, fill_);
    EXPECT_TRUE(wait_for([&] { return !device->is_opening(); }));
    EXPECT_FALSE(device->works());
    EXPECT_EQ(device->problem(), "There is no 'desk'.");
    machine_->plug("desk", true);
    device = audio_.open({"desk", true, 1}, fill_);
    EXPECT_TRUE(wait_for([&] { return device->works(); }));
    EXPECT_EQ(machine_->block()[0], 1.0f);
    machine_->plug("desk", false);
    EXPECT_TRUE(wait_for([&] { return !device->works(); }));
    EXPECT_FALSE(device->is_opening());
}

TEST_F(Audio, ASystemThatStandsStillHoldsNobody) {
    machine_->plug("desk", true);
    auto used = audio_.open({"desk", false, 1}, fill_);
    EXPECT_TRUE(wait_for([&] { return used->works(); }));
    machine_->set(true);
    auto device = audio_.open({"desk", false, 1}, fill_);
    bool answered = false;
    audio_.ask([&](const DeviceList&) { answered = true; });
    EXPECT_TRUE(device->is_opening());
    EXPECT_FALSE(audio_.wait_until_idle(1ms));
    device.reset();
    used.reset();
    EXPECT_FALSE(answered);
    // The system still calls for samples of one whose owner has gone.
    EXPECT_EQ(machine_->block()[0], 0.0f);
    machine_->set(false);
    EXPECT_TRUE(audio_.wait_until_idle(20s));
    EXPECT_TRUE(answered);
    EXPECT_TRUE(machine_->open.empty());
}

TEST_F(Audio, TheOldOneEndsFirst) {
    machine_->plug("desk", true);
    machine_->plug("headset", true);
    auto device = audio_.open({"desk", false, 1}, fill_);
    device.reset();
    device = audio_.open({"headset", false, 1}, fill_);
    EXPECT_TRUE(wait_for([&] { return device->works(); }));
    const std::string called = machine_->called();
    EXPECT_TRUE(called == "open desk|close desk|open headset|" || called == "open headset|")
        << called;
}

TEST(AudioThread, EndsWhileTheSystemStandsStill) {
    const auto machine = std::make_shared<SystemState>();
    machine->plug("desk", true);
    machine->set(true);
    std::unique_ptr<SoundDevice> device;
    {
        AudioThread audio(std::make_unique<StandInSystem>(machine));
        device = audio.open({"desk", false, 1}, [](std::span<float>) {});
    }
    EXPECT_TRUE(device->is_opening());
    device.reset();
    machine->set(false);
}

}  // namespace
}  // namespace theatron::sound
