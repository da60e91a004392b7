// SPDX-License-Identifier: Apache-2.0
#include "sound/audio_thread.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/fault.h"
#include "base/thread_name.h"

namespace theatron::sound {
namespace {

constexpr Duration look_interval = std::chrono::milliseconds(200);

// Data that a device's owner, the audio thread and the system's threads share.
struct Link {
    enum class State { opening, works, failed, gone };
    std::atomic<State> state = State::opening;

    const AudioSystem::Block block;  // of the owner; pass() only
    std::atomic<bool> has_owner = true;
    std::atomic<int> passing = 0;  // calls of pass() that go on

    std::mutex mutex;
    std::string problem;  // under mutex

    std::optional<AudioSystem::DeviceId> id;  // the audio thread's

    explicit Link(AudioSystem::Block b) : block(std::move(b)) {}

    // A block that arrives is passed on while the owner is there. From the system's threads; takes
    // no lock.
    void pass(std::span<float> samples, bool captures) {
        ++passing;
        if (has_owner)
            block(samples);
        else if (!captures)
            std::fill(samples.begin(), samples.end(), 0.0f);
        --passing;
        passing.notify_all();
    }
    // Waits for a block that is being passed on, not for the system. Behind it none is passed on.
    void leave() {
        has_owner = false;
        for (int calls = passing; calls > 0; calls = passing)
            passing.wait(calls);
    }
};

}  // namespace

struct AudioThread::Shared {
    using Job = std::function<void(AudioSystem&)>;

    std::mutex mutex;
    std::condition_variable changed;
    std::deque<Job> jobs;
    bool works_on_one = false, ends = false;

    // The thread's own.
    std::vector<std::shared_ptr<Link>> open;

    void add(Job job) {
        {
            const std::lock_guard lock(mutex);
            jobs.push_back(std::move(job));
        }
        changed.notify_all();
    }

    void run(AudioSystem& system) {
        name_this_thread("audio");
        std::unique_lock lock(mutex);
        while (!ends || !jobs.empty()) {
            if (jobs.empty()) {
                const auto must_work = [this] { return ends || !jobs.empty(); };
                if (open.empty()) {
                    changed.wait(lock, must_work);
                } else if (!changed.wait_for(lock, look_interval, must_work)) {
                    lock.unlock();
                    (void)contain("audio", [&] { look(system); });
                    lock.lock();
                }
                continue;
            }
            Job job = std::move(jobs.front());
            jobs.pop_front();
            works_on_one = true;
            lock.unlock();
            (void)contain("audio", [&] { job(system); });
            job = nullptr;
            lock.lock();
            works_on_one = false;
            changed.notify_all();
        }
    }

    void look(AudioSystem& system) {
        for (const std::shared_ptr<Link>& link : open)
            if (link->state == Link::State::works && !system.works(*link->id))
                link->state = Link::State::gone;
    }
};

namespace {

class AskedDevice : public SoundDevice {
public:
    AskedDevice(std::shared_ptr<Link> link, std::function<void()> close)
        : link_(std::move(link)), close_(std::move(close)) {}
    ~AskedDevice() override {
        link_->leave();
        close_();
    }
    bool is_opening() const override { return link_->state == Link::State::opening; }
    bool works() const override { return link_->state == Link::State::works; }
    std::string problem() const override {
        const std::lock_guard lock(link_->mutex);
        return link_->problem;
    }
    AskedDevice(const AskedDevice&) = delete;
    AskedDevice& operator=(const AskedDevice&) = delete;

private:
    const std::shared_ptr<Link> link_;
    const std::function<void()> close_;
};

}  // namespace

AudioThread::AudioThread(std::unique_ptr<AudioSystem> system)
    : shared_(std::make_shared<Shared>()) {
    std::thread([shared = shared_, system = std::move(system)] { shared->run(*system); }).detach();
}

AudioThread::~AudioThread() {
    (void)wait_until_idle(patience);
    {
        const std::lock_guard lock(shared_->mutex);
        shared_->ends = true;
    }
    shared_->changed.notify_all();
}

std::unique_ptr<SoundDevice> AudioThread::open(AudioSystem::Wanted wanted,
                                               AudioSystem::Block block) {
    const auto link = std::make_shared<Link>(std::move(block));
    shared_->add([shared = shared_.get(), link, wanted = std::move(wanted)](AudioSystem& system) {
        const bool captures = wanted.captures;
        std::string problem;
        if (!link->has_owner)
            return;
        const bool is_open = contain("audio", [&] {
            try {
                link->id = system.open(wanted, [link, captures](std::span<float> samples) {
                    link->pass(samples, captures);
                });
            } catch (const Error& error) {
                problem = error.what();
            }
        });
        if (!link->id) {
            if (!is_open)
                problem = "The sound of this machine has a fault. You can take part without it.";
            const std::lock_guard lock(link->mutex);
            link->problem = problem;
            link->state = Link::State::failed;
            return;
        }
        shared->open.push_back(link);
        link->state = Link::State::works;
    });
    return std::make_unique<AskedDevice>(link, [shared = shared_, link] {
        shared->add([shared = shared.get(), link](AudioSystem& system) {
            if (!link->id)
                return;
            std::erase(shared->open, link);
            system.close(*link->id);
        });
    });
}

void AudioThread::ask(std::function<void(DeviceList)> answer) {
    shared_->add([answer = std::move(answer)](AudioSystem& system) { answer(system.devices()); });
}

bool AudioThread::wait_until_idle(Duration patience) {
    std::unique_lock lock(shared_->mutex);
    return shared_->changed.wait_for(
        lock, patience, [this] { return shared_->jobs.empty() && !shared_->works_on_one; });
}

AudioThread& AudioThread::shared() {
    // Never destroyed: its thread may stand in the system for ever.
    static AudioThread& thread = *new AudioThread(sdl_audio());
    return thread;
}

}  // namespace theatron::sound
