# tools/skipped: the reasons that ctest keeps to itself, from a small ctest run of this script's own.
tool=$(cd "$(dirname "$0")/../../tools" && pwd)/skipped
. "$(dirname "$0")/common.sh"
fails "no log, no reasons" sh -c "'$tool' . | grep ."
cat >CTestTestfile.cmake <<'END'
add_test(one "sh" "-c" "echo 'skipped: no such program here'; echo '   its log'; exit 77")
add_test(folder/two "sh" "-c" "echo '  ok    a check'; echo '  left out: a full disk (no tmpfs)'")
add_test(three "sh" "-c" "echo 'nothing was skipped: all is well'")
set_tests_properties(one folder/two three PROPERTIES SKIP_RETURN_CODE 77)
END
ctest >ctest.txt
"$tool" . >out.txt
cat >expected.txt <<'END'
skipped: one (no such program here)
left out: folder/two (a full disk (no tmpfs))
END
holds "a reason for each" diff expected.txt out.txt
finish
