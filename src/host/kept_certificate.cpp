// SPDX-License-Identifier: Apache-2.0
#include "host/kept_certificate.h"

#include <algorithm>
#include <utility>

#include "base/error.h"

namespace theatron::host {
namespace {

constexpr files::UtcSeconds day = 24 * 3600;
// The browsers alone know whether a host of this name was ever started with --hsts.
constexpr const char* browsers_warn = "browsers warn, and let nobody go on where --hsts was used";

}  // namespace

KeptCertificate::KeptCertificate(net::Certificate own, const std::filesystem::path& folder)
    : current_(std::move(own)),
      validity_(net::validity_of(current_)),
      what_("The host's own certificate"),
      advice_("delete host.crt and host.key in '" + folder.string() +
              "' and start the host again, after which old links no longer work.") {}

KeptCertificate::KeptCertificate(net::CertificateFiles files)
    : files_(std::move(files)),
      current_(files_->read()),
      validity_(net::validity_of(current_)),
      what_("The certificate '" + files_->certificate().string() + "'"),
      advice_("put a new one into its place.") {}

bool KeptCertificate::follow(const std::function<void(const net::Certificate&)>& use,
                             files::UtcSeconds now) {
    if (!files_)
        return false;
    try {
        if (auto fresh = files_->changed())
            waiting_ = std::move(fresh);
        if (!waiting_)
            return false;
        const net::Validity validity = net::validity_of(*waiting_);
        if (now < validity.begins) {
            unused_ = not_yet_text(validity);
            return false;
        }
        if (now > validity.ends) {
            unused_ = what_ + " has expired, at " + files::utc_text(validity.ends) +
                      "; set this machine's clock if it is wrong, else renew it.";
            return false;
        }
        // A certificate that cannot be used is tried once.
        net::Certificate fresh = *std::exchange(waiting_, std::nullopt);
        use(fresh);
        unused_.clear();
        const bool is_other = fresh.fingerprint != current_.fingerprint;
        current_ = std::move(fresh);
        validity_ = validity;
        return is_other;
    } catch (const Error& error) {
        waiting_.reset();
        unused_ = error.what();
        return false;
    }
}

// Without the time, so that it is told once.
std::string KeptCertificate::not_yet_text(const net::Validity& validity) const {
    return what_ + " is valid only from " + files::utc_text(validity.begins) +
           " on; set this machine's clock if it is wrong, else wait.";
}

std::string KeptCertificate::end_text(files::UtcSeconds now) const {
    const std::string end = files::utc_text(validity_.ends);
    const files::UtcSeconds days = (validity_.ends - now) / day;
    if (now > validity_.ends)
        return what_ + " expired at " + end + ", so " + browsers_warn + "; " + advice_;
    return what_ + " expires at " + end + ", in " +
           (days == 0   ? "less than a day; "
            : days == 1 ? "1 day; "
                        : std::to_string(days) + " days; ") +
           advice_;
}

std::string KeptCertificate::problem(files::UtcSeconds now, const std::string& name) const {
    if (!unused_.empty())
        return unused_ + " Until then the certificate that " +
               (now > validity_.ends ? "expired" : "expires") + " at " +
               files::utc_text(validity_.ends) + " stays in use.";
    if (now < validity_.begins)
        return not_yet_text(validity_) + " Until then " + browsers_warn + ".";
    const files::UtcSeconds notice =
        std::min(longest_notice, (validity_.ends - validity_.begins) / 3);
    if (now > validity_.ends - notice)
        return end_text(now);
    if (files_ && !name.empty() && !net::is_for(current_, name))
        return what_ + " is not one for '" + name + "', the name in the links, so " +
               browsers_warn +
               "; ask for one with that name, or "
               "change the name with --public-name.";
    return "";
}

}  // namespace theatron::host
