#!/bin/sh
# Installs Chromium for the tests of the page where that may be done: as root, with apt-get. Without
# a network it gives up within some 20 s; the tests that need it are skipped then, by name.
cd "$(dirname "$0")/../.." || exit 0
for name in chromium chromium-browser google-chrome; do
  command -v "$name" >/dev/null 2>&1 && exit 0
done
if [ "$(id -u)" != 0 ] || ! command -v apt-get >/dev/null 2>&1; then
  echo "no Chromium, and it cannot be installed here: tests that need it are skipped"
  exit 0
fi
mkdir -p build
installing=build/chromium.installing # tests of the page wait while this is there
: >"$installing"
trap 'rm -f "$installing"' EXIT
export DEBIAN_FRONTEND=noninteractive
quick="-qq -o Acquire::http::Timeout=5 -o Acquire::https::Timeout=5 -o Acquire::Retries=0"
# only downloads are cut short: an installation that is killed would leave the system half done
if timeout 20 apt-get $quick update >/dev/null 2>&1; timeout 240 apt-get $quick install -y \
    --no-install-recommends --download-only chromium >/dev/null 2>&1 &&
  apt-get -qq install -y --no-install-recommends --no-download chromium >/dev/null 2>&1; then
  echo "Chromium is installed"
else
  echo "Chromium could not be installed: tests that need it are skipped"
fi
