# links.sh DOC: every link of the pages in the folder DOC of an installed tree leads to something in there.
set -u
cd "$1" || exit 1
dead=0
checks=0

# outside blocks of code
for page in *.md docs/*.md; do
   for link in $(awk '/^```/ {inside = !inside} !inside' "$page" | grep -o '](\([^)]*\))' | sed 's/^](//; s/[#)].*//'); do
      case $link in
      http*) continue ;;
      esac
      checks=$((checks + 1))
      place=$(realpath -m "$(dirname "$page")/$link")
      case $place in
      "$PWD"/*) [ -e "$place" ] && continue ;;
      esac
      echo "$page: nothing is at $link"
      dead=1
   done
done
[ $dead = 0 ] && [ $checks -ge 40 ]
