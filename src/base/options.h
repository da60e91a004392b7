// SPDX-License-Identifier: Apache-2.0
// The one syntax of cameras, codecs and renderers on the command line and in
// the protocol: `kind`, `kind:value`, `kind:value,key=value` or `kind:key=value`.
// For example `synthetic:surgeon,seed=3`, `folder:DIR,fps=30,loop=1`, `zstd:delta=1`.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace theatron {

// A parsed specification. Nothing throws while it is read: the first thing that
// is wrong is kept as one sentence, and the reader asks for it at the end.
class Options {
public:
    static Options parse(std::string_view text);

    const std::string& text() const { return text_; }  // for sentences: without secrets
    const std::string& kind() const { return kind_; }
    const std::string& value() const { return value_; }

    // Each returns the key's value, or `fallback` where it is not given or is
    // wrong: no number, or outside [min, max].
    std::string take(std::string_view key, std::string_view fallback = "");
    double take_number(std::string_view key, double fallback, double min, double max);
    int take_int(std::string_view key, int fallback, int min, int max);
    bool take_flag(std::string_view key, bool fallback = false);  // 0 or 1

    // The first problem as a sentence for the user; empty if there is none. A key that
    // was given and never taken is a problem too, so call this after the last take.
    std::string problem() const;

    // Throws Error with problem(), if there is one.
    void require_no_problem() const;

private:
    void note(std::string problem);

    std::string text_;
    std::string kind_;
    std::string value_;
    std::map<std::string, std::string, std::less<>> keys_;
    std::string problem_;
};

}  // namespace theatron
