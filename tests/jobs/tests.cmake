add_test(NAME jobs_scripts COMMAND ${CMAKE_CURRENT_LIST_DIR}/scripts_test.sh)
set_tests_properties(jobs_scripts PROPERTIES LABELS jobs TIMEOUT 60)

# The Slurm script on a one-node Slurm: takes minutes and starts daemons, so only where it is asked for.
option(HEXFIELD_SLURM_TESTS "Test jobs/hexfield.sbatch on a Slurm started for the test" OFF)
if(HEXFIELD_SLURM_TESTS AND TARGET hexfield)
  add_test(NAME jobs_slurm
    COMMAND ${CMAKE_CURRENT_LIST_DIR}/slurm_test.sh $<TARGET_FILE:hexfield> ${CMAKE_CURRENT_BINARY_DIR}/slurm)
  set_tests_properties(jobs_slurm PROPERTIES LABELS slurm TIMEOUT 1500 RUN_SERIAL ON SKIP_RETURN_CODE 77)
endif()
