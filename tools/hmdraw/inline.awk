# One page of HTML from many files: what <link href="FILE"> and <script src="FILE"> on lines of their
# own refer to takes their place. -v dir= says where the files are.
match($0, / (src|href)="[^":,]+"/) {
    file = substr($0, RSTART + 1, RLENGTH - 2)
    sub(/^[a-z]*="/, "", file)
    style = $0 ~ /^<link/
    begin = $0
    sub(/ src=.*/, ">", begin)
    print style ? "<style>" : begin
    while ((got = (getline line < (dir "/" file))) > 0)
        print line
    if (got < 0) {
        print "cannot read " dir "/" file >"/dev/stderr"
        exit 1
    }
    print style ? "</style>" : "</script>"
    next
}
{ print }
