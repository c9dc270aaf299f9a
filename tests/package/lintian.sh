# lintian.sh PACKAGES...: lintian has no error and no warning, but for what is of no concern here.
#   initial-upload-closes-no-bugs  the packages are not for Debian's archive
#   maintscript-calls-ldconfig     CPack writes these calls, beside which the trigger is there
set -eu
command -v lintian >/dev/null || { echo "skipped: lintian is not installed"; exit 77; }
complaints=$(lintian --allow-root --suppress-tags initial-upload-closes-no-bugs,maintscript-calls-ldconfig "$@")
echo "$complaints"
[ -z "$complaints" ]
