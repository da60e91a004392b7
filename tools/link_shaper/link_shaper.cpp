// SPDX-License-Identifier: Apache-2.0
// A link between two network namespaces that behaves as a script says: delay,
// rate, a buffer in front of the rate, loss, reordering, each changing over time.
//
//   link_shaper NAMESPACE_A NAMESPACE_B SETTING... [--at SECONDS SETTING...]...
//
// Makes a TUN device "shaped" in each namespace (10.77.0.1 and 10.77.0.2) and
// carries packets between them until it is ended. Settings hold for both ways:
//
//   delay_ms=30      from one side to the other
//   rate_mbit=40     0: no limit
//   rate=25%         of the last rate_mbit
//   buffer_ms=500    packets that wait longer than this for the rate are dropped
//   loss=1%          of packets
//   burst=4          packets that are lost in a row, on average (Gilbert's model); 1: each by
//   chance jitter_ms=5      each packet takes up to that much longer; none overtakes another
//   reorder=2%       of packets overtake those that were sent up to 10 ms before
//
// A line on standard input is either "begin", which sets the time to 0, or settings
// that apply from now on. Before the first "begin", times count from "ready".
// Needs root and /dev/net/tun.
#include <arpa/inet.h>
#include <fcntl.h>
#include <linux/if_tun.h>
#include <net/if.h>
#include <netinet/in.h>
#include <poll.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;
using Time = Clock::time_point;
using Seconds = std::chrono::duration<double>;

constexpr int mtu = 1500;

[[noreturn]] void fail(const std::string& what) {
    std::fprintf(stderr, "link_shaper: %s%s%s\n", what.c_str(), errno ? ": " : "",
                 errno ? std::strerror(errno) : "");
    std::exit(1);
}

Clock::duration from_seconds(double seconds) {
    return std::chrono::duration_cast<Clock::duration>(Seconds(seconds));
}

struct Shape {
    double delay_s = 0;
    double full_rate = 0, rate = 0;  // bytes a second
    double buffer_s = 0.5;
    double loss = 0, reorder = 0;
    double burst = 1;  // packets
    double jitter_s = 0;
};

double number(const std::string& text, const char* unit) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (end == text.c_str() || std::string(end) != unit || value < 0) {
        errno = 0;
        fail("'" + text + "' is not a number" + (*unit ? std::string(" with ") + unit : ""));
    }
    return value;
}

void set(Shape& shape, const std::string& setting) {
    const auto equals = setting.find('=');
    const std::string key = setting.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : setting.substr(equals + 1);
    if (key == "delay_ms")
        shape.delay_s = number(value, "") / 1000;
    else if (key == "rate_mbit")
        shape.full_rate = shape.rate = number(value, "") * 1e6 / 8;
    else if (key == "rate")
        shape.rate = shape.full_rate * number(value, "%") / 100;
    else if (key == "buffer_ms")
        shape.buffer_s = number(value, "") / 1000;
    else if (key == "loss")
        shape.loss = number(value, "%") / 100;
    else if (key == "burst")
        shape.burst = std::max(1.0, number(value, ""));
    else if (key == "jitter_ms")
        shape.jitter_s = number(value, "") / 1000;
    else if (key == "reorder")
        shape.reorder = number(value, "%") / 100;
    else {
        errno = 0;
        fail("there is no setting '" + setting + "'");
    }
}

void configure(const char* device, const char* address) {
    const int s = socket(AF_INET, SOCK_DGRAM, 0);
    ifreq request{};
    std::strncpy(request.ifr_name, device, IFNAMSIZ - 1);
    auto* in = reinterpret_cast<sockaddr_in*>(&request.ifr_addr);
    in->sin_family = AF_INET;
    inet_pton(AF_INET, address, &in->sin_addr);
    if (ioctl(s, SIOCSIFADDR, &request) < 0)
        fail("cannot give the device an address");
    inet_pton(AF_INET, "255.255.255.0", &in->sin_addr);
    if (ioctl(s, SIOCSIFNETMASK, &request) < 0)
        fail("cannot give the device a network");
    request.ifr_mtu = mtu;
    if (ioctl(s, SIOCSIFMTU, &request) < 0)
        fail("cannot set the size of packets");
    // Queueing is this program's business: the device's own queue stays short.
    request.ifr_qlen = 2000;
    (void)ioctl(s, SIOCSIFTXQLEN, &request);
    if (ioctl(s, SIOCGIFFLAGS, &request) < 0)
        fail("cannot read the device's flags");
    request.ifr_flags |= IFF_UP | IFF_RUNNING;
    if (ioctl(s, SIOCSIFFLAGS, &request) < 0)
        fail("cannot bring the device up");
    close(s);
}

int open_tun(const std::string& name_space, const char* address) {
    const int ns = open(("/run/netns/" + name_space).c_str(), O_RDONLY | O_CLOEXEC);
    if (ns < 0)
        fail("there is no network namespace " + name_space);
    if (setns(ns, CLONE_NEWNET) < 0)
        fail("cannot enter the network namespace " + name_space);
    close(ns);
    const int tun = open("/dev/net/tun", O_RDWR | O_NONBLOCK | O_CLOEXEC);
    if (tun < 0)
        fail("cannot open /dev/net/tun");
    ifreq request{};
    request.ifr_flags = IFF_TUN | IFF_NO_PI;
    std::strncpy(request.ifr_name, "shaped", IFNAMSIZ - 1);
    if (ioctl(tun, TUNSETIFF, &request) < 0)
        fail("cannot make a TUN device");
    configure("shaped", address);
    return tun;
}

// One way of the link.
class Way {
public:
    Way(int from, int to, unsigned seed) : from_(from), to_(to), random_(seed) {}

    void take(const Shape& shape, Time now) {
        std::vector<char> packet(mtu + 64);
        while (true) {
            const ssize_t size = read(from_, packet.data(), packet.size());
            if (size <= 0)
                return;
            if (loses(shape))
                continue;
            waiting_.emplace_back(packet.begin(), packet.begin() + size);
            waiting_bytes_ += double(size);
            if (shape.rate > 0 && waiting_bytes_ > shape.rate * shape.buffer_s + mtu) {
                waiting_bytes_ -= double(waiting_.back().size());
                waiting_.pop_back();
            } else if (waiting_.size() == 1) {
                free_at_ = std::max(free_at_, now);
            }
        }
    }

    // Serves at the present rate, then delivers the packets whose delay is over.
    void move(const Shape& shape, Time now) {
        while (!waiting_.empty()) {
            const double size = double(waiting_.front().size());
            const Time done = free_at_ + from_seconds(shape.rate > 0 ? size / shape.rate : 0);
            if (done > now)
                break;
            free_at_ = done;
            const double delay = shape.delay_s + shape.jitter_s * unit_(random_);
            Time there = last_there_ = std::max(last_there_, done + from_seconds(delay));
            if (chance(shape.reorder))
                there = std::max(done, there - from_seconds(0.01));
            travelling_.emplace(there, std::move(waiting_.front()));
            waiting_.pop_front();
            waiting_bytes_ -= size;
        }
        while (!travelling_.empty() && travelling_.begin()->first <= now) {
            const std::vector<char>& packet = travelling_.begin()->second;
            // A full device loses the packet, as a network would.
            (void)!write(to_, packet.data(), packet.size());
            travelling_.erase(travelling_.begin());
        }
    }

    // When move() has something to do next.
    Time next(const Shape& shape) const {
        Time time = Time::max();
        if (!waiting_.empty()) {
            const double size = double(waiting_.front().size());
            time = free_at_ + from_seconds(shape.rate > 0 ? size / shape.rate : 0);
        }
        return travelling_.empty() ? time : std::min(time, travelling_.begin()->first);
    }

private:
    bool chance(double share) { return share > 0 && unit_(random_) < share; }

    // Runs of lost packets begin so often that their share of all packets is `loss`.
    bool loses(const Shape& shape) {
        const double kept = 1 - shape.loss;
        const double change = in_burst_   ? 1 / shape.burst
                              : kept <= 0 ? 1
                                          : shape.loss / (shape.burst * kept);
        if (shape.burst <= 1)
            in_burst_ = chance(shape.loss);
        else if (chance(change))
            in_burst_ = !in_burst_;
        return in_burst_;
    }

    int from_, to_;
    std::deque<std::vector<char>> waiting_;
    double waiting_bytes_ = 0;
    Time free_at_;  // when the last packet was through
    std::multimap<Time, std::vector<char>> travelling_;
    Time last_there_;  // of the packets that have left, when the last one arrives
    bool in_burst_ = false;
    std::mt19937 random_;
    std::uniform_real_distribution<> unit_{0, 1};
};

struct Change {
    double at_s = 0;
    std::vector<std::string> settings;
};

std::vector<Change> parse_script(int count, char** words) {
    std::vector<Change> script(1);
    for (int i = 0; i < count; ++i) {
        const std::string word = words[i];
        if (word == "--at" && i + 1 < count)
            script.push_back({number(words[++i], ""), {}});
        else
            script.back().settings.push_back(word);
    }
    Shape trial;
    for (const Change& change : script)
        for (const std::string& setting : change.settings)
            set(trial, setting);
    return script;
}

void set_timer(int timer, Time at) {
    const auto ns =
        std::chrono::duration_cast<std::chrono::nanoseconds>(at.time_since_epoch()).count();
    itimerspec when{};
    when.it_value.tv_sec = ns / 1'000'000'000;
    when.it_value.tv_nsec = std::max<std::int64_t>(ns % 1'000'000'000, 1);
    timerfd_settime(timer, TFD_TIMER_ABSTIME, &when, nullptr);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) {
        errno = 0;
        fail("say: link_shaper NAMESPACE_A NAMESPACE_B SETTING... [--at SECONDS SETTING...]...");
    }
    const std::vector<Change> script = parse_script(argc - 3, argv + 3);
    const int a = open_tun(argv[1], "10.77.0.1");
    const int b = open_tun(argv[2], "10.77.0.2");
    const int timer = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
    Way ways[] = {Way(a, b, 1), Way(b, a, 2)};

    Shape shape;
    std::puts("ready");
    std::fflush(stdout);
    Time begin = Clock::now();
    std::size_t next_change = 0;
    bool listening = true;
    while (true) {
        Time now = Clock::now();
        while (next_change < script.size() &&
               now >= begin + from_seconds(script[next_change].at_s)) {
            for (const std::string& setting : script[next_change].settings)
                set(shape, setting);
            ++next_change;
        }
        Time wake = next_change < script.size() ? begin + from_seconds(script[next_change].at_s)
                                                : now + std::chrono::seconds(1);
        for (Way& way : ways) {
            way.take(shape, now);
            way.move(shape, now);
            wake = std::min(wake, way.next(shape));
        }
        set_timer(timer, wake);
        pollfd waits[] = {{a, POLLIN, 0},
                          {b, POLLIN, 0},
                          {timer, POLLIN, 0},
                          {listening ? STDIN_FILENO : -1, POLLIN, 0}};
        poll(waits, 4, -1);
        std::uint64_t expired = 0;
        (void)!read(timer, &expired, sizeof(expired));
        if (waits[3].revents != 0) {
            char line[256];
            const ssize_t size = read(STDIN_FILENO, line, sizeof(line));
            listening = size > 0;
            std::istringstream words(std::string(line, std::size_t(std::max<ssize_t>(size, 0))));
            for (std::string word; words >> word;) {
                if (word != "begin") {
                    set(shape, word);
                    continue;
                }
                begin = Clock::now();
                shape = {};
                next_change = 0;
            }
        }
    }
}
