// SPDX-License-Identifier: Apache-2.0
#include "host/cases_folder.h"

#include "base/outside_text.h"
#include "cases/manifest.h"

namespace theatron::host {
namespace fs = std::filesystem;

std::string advice_on_cases_folder(const fs::path& folder) {
    const std::string name = "'" + clean_text(folder.string(), 300) + "'";
    std::error_code ignored;
    if (fs::exists(folder / cases::manifest_name, ignored))
        return name +
               " is itself a case, and --cases names the folder in which cases lie; name the one "
               "above it.";
    bool has_others = false;
    std::error_code failed;
    for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end;
         entry.increment(failed)) {
        if (fs::exists(entry->path() / cases::manifest_name, ignored))
            return "";
        has_others = has_others || !entry->path().filename().string().starts_with('.');
    }
    if (!has_others || failed)
        return "";
    return "There is no case in " + name +
           ", but there is something else; if these are images or models, make a case of them with "
           "'theatron case import' and name the folder in which it lies.";
}

}  // namespace theatron::host
