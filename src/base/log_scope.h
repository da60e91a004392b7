// SPDX-License-Identifier: Apache-2.0
// Marks lines with the session that they are about, where one program has several.
#pragma once

#include <functional>
#include <string>
#include <utility>

namespace theatron::log {

// While this object lives, lines of this thread end with `session=NAME`, and sentences of say()
// begin with "NAME: ". Nothing changes for an empty name. The newest one of a thread counts.
class SessionScope {
public:
    explicit SessionScope(const std::string& name);
    ~SessionScope();
    SessionScope(const SessionScope&) = delete;
    SessionScope& operator=(const SessionScope&) = delete;

private:
    const std::string name_;
    const std::string* const outer_;
};

// The same for each call of `work`; an empty one stays empty.
template <class Result, class... Arguments>
std::function<Result(Arguments...)> in_session(const std::string& name,
                                               std::function<Result(Arguments...)> work) {
    if (name.empty() || !work)
        return work;
    return [name, work = std::move(work)](Arguments... arguments) -> Result {
        const SessionScope scope(name);
        return work(std::forward<Arguments>(arguments)...);
    };
}

}  // namespace theatron::log
