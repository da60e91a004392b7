// SPDX-License-Identifier: Apache-2.0
#include "browser_page.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <thread>

#include "base/error.h"
#include "base/steady_clock.h"

namespace theatron::bench {
namespace {

constexpr int patience_ms = 60'000;

[[noreturn]] void fail_to_start() {
    throw Error("Chromium does not start; try it by hand: chromium --headless=new");
}

std::string new_folder() {
    std::string path =
        (std::filesystem::temp_directory_path() / "theatron_browser_XXXXXX").string();
    if (!mkdtemp(path.data()))
        throw Error("No folder can be made for the browser's profile in '" + path + "'.");
    return path;
}

// Only system calls, because it runs between fork and exec. The protocol's pipes become the
// descriptors 3 and 4.
void become_browser(int commands, int answers, char* const* arguments, pid_t parent) {
    // Its own processes end with the group.
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const int nothing = open("/dev/null", O_RDWR);
    // Above 4, so that neither is lost when the other takes its place.
    const int from = fcntl(commands, F_DUPFD_CLOEXEC, 10);
    const int to = fcntl(answers, F_DUPFD_CLOEXEC, 10);
    if (getppid() == parent && dup2(nothing, 0) >= 0 && dup2(nothing, 1) >= 0 &&
        dup2(nothing, 2) >= 0 && dup2(from, 3) >= 0 && dup2(to, 4) >= 0)
        execv(arguments[0], arguments);
    _exit(127);
}

}  // namespace

std::optional<std::string> find_chromium() {
    const char* const path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');)
        if (const std::string program = folder + "/chromium"; access(program.c_str(), X_OK) == 0)
            return program;
    return std::nullopt;
}

BrowserPage::BrowserPage(const std::string& chromium, Size size, const std::string& script)
    : profile_(new_folder()) {
    std::vector<std::string> arguments = {chromium,
                                          "--headless=new",
                                          "--no-sandbox",
                                          "--disable-dev-shm-usage",
                                          "--use-gl=angle",
                                          "--use-angle=gles-egl",
                                          "--ignore-gpu-blocklist",
                                          "--ignore-certificate-errors",
                                          "--no-first-run",
                                          "--disable-background-networking",
                                          "--remote-debugging-pipe",
                                          "--user-data-dir=" + profile_,
                                          "about:blank"};
    std::vector<char*> argv;
    for (std::string& argument : arguments)
        argv.push_back(argument.data());
    argv.push_back(nullptr);
    int to_child[2], from_child[2];
    if (pipe2(to_child, O_CLOEXEC) != 0 || pipe2(from_child, O_CLOEXEC) != 0)
        fail_to_start();
    const pid_t parent = getpid();
    pid_ = fork();
    if (pid_ == 0)
        become_browser(to_child[0], from_child[1], argv.data(), parent);
    close(to_child[0]);
    close(from_child[1]);
    commands_ = to_child[1];
    answers_ = from_child[0];
    if (pid_ < 0)
        fail_to_start();
    // A browser that has ended is noticed by its answers.
    signal(SIGPIPE, SIG_IGN);

    const auto target = call("Target.createTarget", {{"url", "about:blank"}, {"newWindow", true}});
    session_ = call("Target.attachToTarget", {{"targetId", target["targetId"]}, {"flatten", true}})
                   .at("sessionId")
                   .get<std::string>();
    for (const char* domain : {"Runtime.enable", "Network.enable", "Page.enable"})
        call(domain, nlohmann::json::object());
    call("Emulation.setDeviceMetricsOverride", {{"width", size.width},
                                                {"height", size.height},
                                                {"deviceScaleFactor", 1},
                                                {"mobile", false}});
    call("Page.addScriptToEvaluateOnNewDocument", {{"source", script}});
}

BrowserPage::~BrowserPage() {
    if (pid_ > 0) {
        kill(-pid_, SIGKILL);
        kill(pid_, SIGKILL);
        waitpid(pid_, nullptr, 0);
    }
    close(commands_);
    close(answers_);
    std::error_code ignored;
    std::filesystem::remove_all(profile_, ignored);
}

nlohmann::json BrowserPage::next_message() {
    while (true) {
        const std::size_t end = unread_.find('\0');
        if (end != std::string::npos) {
            auto message = nlohmann::json::parse(unread_.substr(0, end));
            unread_.erase(0, end + 1);
            return message;
        }
        pollfd waiting{answers_, POLLIN, 0};
        char part[65536];
        const ssize_t count =
            poll(&waiting, 1, patience_ms) == 1 ? read(answers_, part, sizeof(part)) : 0;
        if (count <= 0)
            throw Error("Chromium does not answer.");
        unread_.append(part, std::size_t(count));
    }
}

void BrowserPage::on_event(const nlohmann::json& message) {
    const std::string method = message.value("method", "");
    if (method == "Network.loadingFinished")
        transferred_bytes_ += std::uint64_t(message["params"]["encodedDataLength"].get<double>());
    else if (method == "Runtime.exceptionThrown")
        problems_.push_back(message["params"]["exceptionDetails"].value("text", ""));
}

nlohmann::json BrowserPage::call(const std::string& method, const nlohmann::json& parameters) {
    nlohmann::json message{{"id", ++last_id_}, {"method", method}, {"params", parameters}};
    if (!session_.empty())
        message["sessionId"] = session_;
    std::string text = message.dump();
    text += '\0';
    if (write(commands_, text.data(), text.size()) != ssize_t(text.size()))
        fail_to_start();
    while (true) {
        nlohmann::json answer = next_message();
        if (!answer.contains("id")) {
            on_event(answer);
        } else if (answer["id"] == last_id_) {
            if (answer.contains("error"))
                throw Error(method + ": " + answer["error"].value("message", "refused"));
            return answer["result"];
        }
    }
}

void BrowserPage::open(const std::string& url) {
    call("Page.navigate", {{"url", url}});
}

nlohmann::json BrowserPage::evaluate(const std::string& expression) {
    const auto result =
        call("Runtime.evaluate",
             {{"expression", expression}, {"awaitPromise", true}, {"returnByValue", true}});
    if (result.contains("exceptionDetails"))
        throw Error("The page failed at '" + expression +
                    "': " + result["exceptionDetails"].dump());
    return result["result"].value("value", nlohmann::json());
}

void BrowserPage::wait_for(const std::string& expression, Duration patience) {
    const TimePoint end = steady_now() + patience;
    while (evaluate("!!(" + expression + ")") != true) {
        if (steady_now() > end)
            throw Error("The page waited in vain for: " + expression);
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
}

}  // namespace theatron::bench
