"""The page on hosting, followed word for word on a clean machine: a minimal Debian root with a network of its own.

Needs root, and Debian's debootstrap, unshare and ip. What a person adds to the page: the repository's address, fresh
lists for apt and a yes, the name's line in /etc/hosts, and a certificate.
"""

import os
import re
import shutil
import subprocess
import time
from pathlib import Path

import pytest

from tests.faults.proxied import SLOW_FLOW
from tests.faults.test_hosting import commands

ROOT = Path(__file__).parents[2]
SYSTEM, PACKAGES = "bookworm", "sudo,ca-certificates,openssl"
NAME = "explorer.example.org"
LONGEST = 3600.0  # seconds for one part: what is installed is downloaded, and compiled
ENVIRONMENT = {
    "PATH": "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root", "USER": "root",
    "LANG": "C.UTF-8",
    "DEBIAN_FRONTEND": "noninteractive", "PIP_CERT": "/etc/ssl/certs/ca-certificates.crt",
}  # fmt: skip
#: Makes a root one that programs run in, before it is entered.
ENTER = 'mount -t proc proc "$0/proc"; mount --rbind /dev "$0/dev"; exec chroot "$0" bash -e /begin'
#: In a network of its own there is nobody else, so that ports and names are those of the page.
ALONE = "ip link set lo up; "
VISIT = (
    f"until curl -skf {{0}}ready; do sleep 1; done; test \"$(python -m tests.faults.proxied {{0}})\" = '{SLOW_FLOW}'\n"
)

pytestmark = pytest.mark.skipif(
    os.geteuid() != 0 or not all(map(shutil.which, ("debootstrap", "unshare", "ip", "git"))),
    reason="makes a root: needs to be root, and Debian's debootstrap, unshare, ip and git",
)


@pytest.fixture(scope="module")
def machine(tmp_path_factory):
    """A clean Debian, with the repository as it is committed."""
    root = tmp_path_factory.mktemp("machine") / "root"
    bootstrap = ["debootstrap", "--variant=minbase", f"--include={PACKAGES}", SYSTEM, str(root)]
    subprocess.run(bootstrap, capture_output=True, check=True)
    subprocess.run(["git", "clone", "-q", "--bare", str(ROOT), str(root / "repository")], check=True)
    for name in ("resolv.conf", "ssl/certs/ca-certificates.crt"):
        shutil.copy(f"/etc/{name}", root / "etc" / name)
    (root / "etc/apt/apt.conf.d/yes").write_text('APT::Get::Assume-Yes "true";\n')
    started = root / "usr/sbin/policy-rc.d"  # nothing starts by being installed: the network is not its own yet
    started.write_text("#!/bin/sh\nexit 101\n")
    started.chmod(0o755)
    with (root / "etc/hosts").open("a") as hosts:
        hosts.write(f"127.0.0.1 localhost {NAME}\n")
    yield root
    shutil.rmtree(root.parent)


def follow(root, text, alone):
    """Run commands in a root, with everything that they start; return what they say."""
    (root / "begin").write_text(text)
    enter = ["unshare", "--mount", "--pid", "--fork", "--kill-child", *(["--net"] if alone else [])]
    whole = [*enter, "bash", "-ec", (ALONE if alone else "") + ENTER, str(root)]
    with open(root.parent / "said", "w+") as said:
        began = time.monotonic()
        done = subprocess.run(
            whole, stdout=said, stderr=said, stdin=subprocess.DEVNULL, env=ENVIRONMENT, timeout=LONGEST
        )
        said.seek(0)
        told = said.read()
    assert done.returncode == 0, f"after {time.monotonic() - began:.0f} s:\n{told[-5000:]}"
    return told


HERE = "cd /opt/codim2 && . .venv/bin/activate\n"
#: In place of systemd, which needs a machine: what a unit starts, with its environment.
SYSTEMCTL = """#!/bin/bash
[ $1 = enable ] && shift
shift
for unit; do
    port=${unit#*@} known=/run/codim2-${unit#*@}
    [ ! -f $known ] || { kill $(cat $known); tail --pid $(cat $known) -f /dev/null; }
    start=$(sed -n "s|^ExecStart=||p" /etc/systemd/system/codim2@.service)
    (set -a; . /etc/codim2; exec ${start//%i/$port}) > /dev/null 2>> /run/said & echo $! > $known
done
"""


def test_the_page_on_hosting_word_for_word_on_a_clean_machine(machine):
    """From the clone to TLS, three replicas and a rolling restart, at the name and the ports of the page."""
    (install, _container), (begin, restart) = (
        commands("One machine"),
        commands("Behind a proxy with TLS, three replicas"),
    )
    *before, serve = install.splitlines()
    assert serve.startswith("codim2 serve ")
    upgrade = re.search(r"For an upgrade, first run `(.*?)`", page())[1]
    assert "Use `sudo nginx` if none runs yet" in page()
    stub = machine / "usr/local/bin/systemctl"
    stub.write_text(SYSTEMCTL)
    stub.chmod(0o755)

    follow(machine, "cd\napt update\n" + "\n".join(before).replace("THIS_REPOSITORY", "/repository"), alone=False)
    follow(machine, f"{HERE}{serve} &\n{VISIT.format(f'http://{NAME}:5006/')}kill %1; wait %1 || true\n", alone=True)

    certificate = (
        f"openssl req -x509 -newkey rsa:2048 -nodes -days 2 -subj /CN={NAME} "
        "-keyout /etc/ssl/explorer.key -out /etc/ssl/explorer.pem\n"
    )
    visit = VISIT.format(f"https://{NAME}/")
    first = begin.replace("sudo nginx -s reload", "sudo nginx")
    pids = "cat /run/codim2-500[678] | tee /dev/stderr > /tmp/{0}\n"
    told = follow(
        machine,
        f"{HERE}{certificate}{first}{visit}{pids.format('before')}sudo nginx -s reload\n"
        f"{restart}{visit}{pids.format('after')}if grep -xf /tmp/before /tmp/after; then exit 1; fi\n"
        "kill $(cat /tmp/after)\ncat /run/said\n",
        alone=True,
    )
    assert "Traceback" not in told
    follow(machine, f"{HERE}{upgrade}\n", alone=False)


def page():
    return (ROOT / "app/codim2_app/site/docs/text/hosting.md").read_text(encoding="utf-8")
