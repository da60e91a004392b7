// SPDX-License-Identifier: Apache-2.0
// The certificates of a host's port, and what its links say of them.
#include "base/error.h"
#include "base/log.h"
#include "base/outside_text.h"
#include "host/host_identity.h"
#include "host/host_port.h"

namespace theatron::host {
namespace {

// A host that people cannot reach as its options say does not start.
void check_access(const PortOptions& options) {
    const bool is_behind_proxy = !options.proxies.empty();
    if (options.insists_on_https && options.certificate.empty())
        throw Error(
            "--hsts forbids browsers to go on after a warning, so it needs a certificate that "
            "they trust: add --certificate and --key, or leave it out.");
    if (is_behind_proxy && (options.public_name.empty() || options.proxy_certificate.empty()))
        throw Error(
            "--behind-proxy needs --public-name, the name in the links, and --proxy-certificate, "
            "the proxy's certificate as a PEM file, which native participants compare.");
    if (!is_behind_proxy && !options.proxy_certificate.empty())
        throw Error("--proxy-certificate is that of a proxy; add --behind-proxy ADDRESS.");
    if (!options.public_name.empty() && !options.link_host.empty())
        throw Error("--public-name is also the name in the links; leave out --link-host.");
    if (!options.link_host.empty() && !net::can_be_linked(options.link_host))
        throw Error("--link-host '" + clean_text(options.link_host, 80) +
                    "' is no name or address of a host; write it alone, without https:// and "
                    "port, for example or-3.hospital.example.");
}

}  // namespace

void HostPort::open_certificates(const std::filesystem::path& state_folder) {
    constexpr std::uint16_t https_port = 443;
    if (certificate_)
        return;
    state_folder_ = state_folder;
    check_access(options_);
    if (options_.certificate.empty())
        certificate_.emplace(net::load_or_make_certificate(state_folder_), state_folder_);
    else
        certificate_.emplace(net::CertificateFiles(options_.certificate, options_.key));
    if (!options_.proxy_certificate.empty())
        proxy_certificate_.emplace(net::CertificateFiles(options_.proxy_certificate, ""));

    access_.proxies = net::Proxies(options_.proxies);
    access_.insists_on_https = options_.insists_on_https;
    if (!options_.public_name.empty())
        access_.name = net::parse_public_name(
            options_.public_name, access_.proxies.empty() ? options_.listen.port : https_port);
}

void HostPort::note_link() {
    const net::Endpoint& listen = options_.listen;
    const bool everywhere = listen.address == "0.0.0.0" || listen.address == "::";
    net::Link link;
    link.host = access_.name                  ? access_.name->name
                : !options_.link_host.empty() ? options_.link_host
                : everywhere                  ? outside_address()
                                              : listen.address;
    link.port = access_.name && access_.name->port != 0 ? access_.name->port : server_->port();
    link.fingerprint = linked_certificate().fingerprint;
    {
        const std::lock_guard lock(mutex_);
        link_ = link;
    }
    tell_address(link);
    note_certificates();
}

// A host goes on without it: those who have their links need no file.
void HostPort::tell_address(const net::Link& link) const {
    try {
        write_address(state_folder_, link);
    } catch (const Error& error) {
        log::warning("host", "'theatron link' shows old links", {{"problem", error.what()}});
    }
}

const net::Certificate& HostPort::linked_certificate() const {
    return (proxy_certificate_ ? *proxy_certificate_ : *certificate_).current();
}

void HostPort::note_certificates() {
    const files::UtcSeconds now = files::utc_now();
    const std::string name = link().host;
    std::vector<HostFigures::Certificate> figures;
    const auto note = [&](const char* of, const KeptCertificate& kept, bool is_in_links) {
        // Browsers see only the one in the links.
        const std::string expected = is_in_links ? name : std::string();
        figures.push_back(
            {of, kept.current().fingerprint, kept.validity().ends, kept.problem(now, expected)});
    };
    note("host", *certificate_, !proxy_certificate_);
    if (proxy_certificate_)
        note("proxy", *proxy_certificate_, true);
    for (const auto& certificate_now : figures) {
        std::string& told = told_of_certificates_[certificate_now.of];
        if (told != certificate_now.problem && !certificate_now.problem.empty())
            log::warning("host", "certificate", {{"problem", certificate_now.problem}});
        told = certificate_now.problem;
    }
    const std::lock_guard lock(mutex_);
    certificates_ = std::move(figures);
}

void HostPort::follow_certificates() {
    const files::UtcSeconds now = files::utc_now();
    const bool is_other = certificate_->follow(
        [&](const net::Certificate& fresh) { server_->set_certificate(fresh); }, now);
    const bool is_proxys_other =
        proxy_certificate_ && proxy_certificate_->follow([](const net::Certificate&) {}, now);
    if (is_other)
        log::info("host", "certificate replaced",
                  {{"expires", files::utc_text(certificate_->validity().ends)}});
    const net::Certificate& linked = linked_certificate();
    if (is_proxys_other || (is_other && !proxy_certificate_)) {
        net::Link address;
        {
            const std::lock_guard lock(mutex_);
            link_.fingerprint = linked.fingerprint;
            address = link_;
        }
        tell_address(address);
        log::info("host", "links changed with the certificate, browsers can use the old ones");
    }
    note_certificates();
}

}  // namespace theatron::host
