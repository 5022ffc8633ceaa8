# Tools that are not all there, and folders that cannot be written, are said before anything runs.
. "$source_dir/tests/tools/pipeline/common.sh"
site slope
mkdir half
ln -s "${bin%%:*}/talus-site" "${bin%%:*}/talus-tin" half
expect 2 make -C slope BIN="$PWD/half/"
says "talus-import talus-trn talus-blocks talus-check talus-batch talus-dda talus-reduce talus-runout talus-maps talus-fence talus-places talus-calibrate talus-hazard talus-trace talus-fence-search talus-report talus-profile cannot be found in $PWD/half/"
expect 2 make -C slope BIN="$PWD/half/" terrain
says "talus-import talus-trn cannot be found in $PWD/half/"
says "build first: sh $source_dir/pipelines/demo.sh; or name the folder of the tools with a slash at its end"
ln -s "${bin%%:*}/talus-import" "${bin%%:*}/talus-trn" half
expect 0 make -C slope BIN="$PWD/half/" terrain
expect 2 make -C slope BIN="${bin%%:*}" terrain
says "name the folder of the tools with a slash at its end"

# a checkout whose build is not whole: the tools on the search path, or none
mkdir -p checkout/build/demo/tools
cp -r "$source_dir/pipelines" checkout/
ln -s "${bin%%:*}/talus-site" checkout/build/demo/tools
echo "include $PWD/checkout/pipelines/site.mk" >slope/Makefile
expect 0 make -C slope terrain
expect 2 env PATH=/usr/bin:/bin make -C slope terrain
says "build first: sh $PWD/checkout/pipelines/demo.sh"
for goal in clean help; do expect 0 env PATH=/usr/bin:/bin make -C slope $goal; done

echo 'a file' >file
expect 2 make -C slope BIN= OUT=../file/out terrain
says "name another folder for the results: make OUT=/where/results"
