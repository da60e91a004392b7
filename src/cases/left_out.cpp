// SPDX-License-Identifier: Apache-2.0
#include "cases/left_out.h"

#include <algorithm>

#include "cases/quoted_path.h"

namespace theatron::cases {

std::string first_names(const std::vector<std::filesystem::path>& files) {
    constexpr std::size_t named = 4;
    const std::size_t count = files.size() <= named + 1 ? files.size() : named;
    std::string text;
    for (std::size_t i = 0; i < count; ++i) {
        const bool is_last = i > 0 && i + 1 == files.size();
        text += (i == 0 ? "" : is_last ? " and " : ", ") + quoted_path(files[i]);
    }
    if (count < files.size())
        text += " and " + std::to_string(files.size() - count) + " more";
    return text;
}

void LeftOut::add(const std::filesystem::path& file, const std::string& reason) {
    auto found = std::find_if(reasons_.begin(), reasons_.end(),
                              [&](const Reason& one) { return one.text == reason; });
    if (found == reasons_.end())
        found = reasons_.insert(reasons_.end(), Reason{reason, {}});
    found->files.push_back(file);
}

void LeftOut::append_to(std::vector<std::string>& remarks) const {
    for (const Reason& reason : reasons_)
        if (reason.files.size() == 1)
            remarks.push_back(quoted_path(reason.files[0]) + " is left out: it " + reason.text +
                              ".");
        else
            remarks.push_back(std::to_string(reason.files.size()) +
                              " files are left out, since each of them " + reason.text + ": " +
                              first_names(reason.files) + ".");
}

}  // namespace theatron::cases
