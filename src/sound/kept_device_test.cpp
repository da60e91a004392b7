// SPDX-License-Identifier: Apache-2.0
#include "sound/kept_device.h"

#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <set>
#include <stdexcept>
#include <vector>

#include "base/error.h"

namespace theatron::sound {
namespace {

// Sockets into which devices are plugged.
struct Machine {
    std::mutex mutex;
    std::set<std::string> plugged;
    std::vector<std::string> sentences;
    int opened = 0, open = 0;
    int faults =
        0;  // attempts to open a device, after the first, that end in an unexpected exception
    std::map<std::string, int> looks;  // attempts to open a device, and questions whether it works

    void plug(const std::string& name, bool is_plugged) {
        const std::lock_guard lock(mutex);
        if (is_plugged)
            plugged.insert(name);
        else
            plugged.erase(name);
    }
    bool has(const std::string& name) {
        const std::lock_guard lock(mutex);
        ++looks[name];
        return plugged.contains(name);
    }
    int looks_at(const std::string& name) {
        const std::lock_guard lock(mutex);
        return looks[name];
    }
    std::string said() {
        const std::lock_guard lock(mutex);
        std::string text;
        for (const std::string& sentence : sentences)
            text += sentence + "|";
        return text;
    }
};

struct Plugged : SoundDevice {
    Plugged(Machine& the_machine, std::string the_name)
        : machine(the_machine), name(std::move(the_name)) {
        const std::lock_guard lock(machine.mutex);
        if (machine.looks[name]++ > 0 && machine.faults-- > 0)
            throw std::runtime_error("a fault of the driver");
        if (!machine.plugged.contains(name))
            throw Error("There is no '" + name + "'.");
        ++machine.opened;
        EXPECT_EQ(++machine.open, 1) << "the old one ends first";
    }
    ~Plugged() override {
        const std::lock_guard lock(machine.mutex);
        --machine.open;
    }
    bool works() const override { return machine.has(name); }
    Machine& machine;
    const std::string name;
};

class Kept : public ::testing::Test {
protected:
    std::unique_ptr<KeptDevice> keep(const std::string& name) {
        return std::make_unique<KeptDevice>(
            "microphone", name,
            [this](const std::string& wanted) {
                return std::make_unique<Plugged>(machine_, wanted);
            },
            [this](const std::string& text) {
                const std::lock_guard lock(machine_.mutex);
                machine_.sentences.push_back(text);
            },
            Duration(1ms));
    }
    template <class Condition>
    static bool wait_for(Condition condition) {
        for (int i = 0; i < 20'000 && !condition(); ++i)
            std::this_thread::sleep_for(1ms);
        return condition();
    }

    // Until a device was looked at again a few times.
    bool time_passes(const std::string& name) {
        return wait_for(
            [&, end = machine_.looks_at(name) + 4] { return machine_.looks_at(name) >= end; });
    }

    Machine machine_;
};

TEST_F(Kept, ComesBackWhenItIsPluggedInAgain) {
    machine_.plug("headset", true);
    const auto device = keep("headset");
    EXPECT_TRUE(device->works());
    machine_.plug("headset", false);
    EXPECT_TRUE(wait_for([&] { return !device->works(); }));
    machine_.plug("headset", true);
    EXPECT_TRUE(wait_for([&] { return device->works(); }));
    EXPECT_EQ(machine_.said(),
              "The microphone 'headset' is gone; it is used again as soon as it is plugged in.|"
              "The microphone 'headset' is there.|");
}

TEST_F(Kept, OneThatIsNotThereYetIsSaidOnceAndOpenedLater) {
    const auto device = keep("headset");
    EXPECT_FALSE(device->works());
    EXPECT_TRUE(time_passes("headset"));
    machine_.plug("headset", true);
    EXPECT_TRUE(wait_for([&] { return device->works(); }));
    EXPECT_EQ(machine_.said(), "There is no 'headset'.|The microphone 'headset' is there.|");
}

TEST_F(Kept, IsExchangedWhileItRuns) {
    machine_.plug("headset", true);
    machine_.plug("desk", true);
    const auto device = keep("headset");
    device->change("desk");
    EXPECT_EQ(device->name(), "desk");
    machine_.plug("headset", false);
    EXPECT_TRUE(time_passes("desk"));
    EXPECT_TRUE(device->works());
    device->change("headset");
    EXPECT_FALSE(device->works());
    EXPECT_EQ(machine_.said(), "There is no 'headset'.|");
}

// One whose system answers later.
struct Slow : SoundDevice {
    explicit Slow(std::atomic<int>& the_answer) : answer(the_answer) {}
    bool is_opening() const override { return answer == 0; }
    bool works() const override { return answer == 1; }
    std::string problem() const override { return answer == 2 ? "It is broken." : ""; }
    std::atomic<int>& answer;
};

TEST_F(Kept, NobodyWaitsForASystemThatDoesNotAnswer) {
    std::atomic<int> answer = 0, tries = 0;
    const auto say = [&](const std::string& text) {
        const std::lock_guard lock(machine_.mutex);
        machine_.sentences.push_back(text);
    };
    KeptDevice device(
        "loudspeaker", "desk",
        [&](const std::string&) {
            ++tries;
            return std::make_unique<Slow>(answer);
        },
        say, Duration(1ms));
    EXPECT_FALSE(device.works());
    EXPECT_EQ(tries, 1) << "a second question would wait behind the first";
    answer = 2;
    EXPECT_TRUE(wait_for([&] { return tries > 3; }));
    EXPECT_EQ(machine_.said(), "It is broken.|");
    answer = 1;
    EXPECT_TRUE(wait_for([&] { return device.works(); }));
    EXPECT_EQ(machine_.said(), "It is broken.|The loudspeaker 'desk' is there.|");
}

TEST_F(Kept, TheUsualOneTakesThePlaceOfAKeptOne) {
    machine_.plug("default", true);
    const KeptDevice device(
        "microphone", "headset",
        [this](const std::string& wanted) { return std::make_unique<Plugged>(machine_, wanted); },
        [this](const std::string& text) {
            const std::lock_guard lock(machine_.mutex);
            machine_.sentences.push_back(text);
        },
        Duration(1ms), true);
    EXPECT_TRUE(wait_for([&] { return device.works(); }));
    EXPECT_EQ(device.name(), "default");
    EXPECT_EQ(machine_.said(),
              "The microphone 'headset' is not plugged in: the usual one is used (choose another "
              "one with P).|");
}

TEST_F(Kept, AFileIsNotTriedAgain) {
    const auto device = keep("said.wav");
    const auto witness = keep("headset");  // of the same interval
    machine_.plug("said.wav", true);
    EXPECT_TRUE(time_passes("headset"));
    EXPECT_FALSE(device->works());
    EXPECT_EQ(machine_.looks_at("said.wav"), 1);
}

TEST_F(Kept, AFaultOfTheDriverEndsOneAttempt) {
    machine_.faults = 3;
    const auto device = keep("headset");
    machine_.plug("headset", true);
    EXPECT_TRUE(wait_for([&] { return device->works(); }));
}

TEST(Devices, OfAMachineAreListedWithoutOpeningAny) {
    // Names of devices are not empty on any machine.
    const DeviceList found = devices();
    for (const auto& names : {found.microphones, found.loudspeakers})
        for (const std::string& name : names)
            EXPECT_FALSE(name.empty());
}

}  // namespace
}  // namespace theatron::sound
